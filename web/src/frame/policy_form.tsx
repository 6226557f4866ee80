// Which policy decides, and another one while no job is admitted.

import { useState } from 'preact/hooks';
import type { Cell } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { why_no_change } from '../policies/change';


type Policy = Cell['scheduling']['policy'];
const kPolicies: Record<Policy, string> = {
  sequential: 'one job at a time in the whole cell',
  lockstep: 'rounds of one job for each arm',
  reservation: 'a motion has all that it sweeps to itself',
  timed_discrete: 'as in the paper: equal instants are compared; nothing is promised between them',
  certified: 'starts now if it is proven to pass all others without a stop, else waits',
  earliest_start: 'starts at the earliest time that is proven to pass all others without a stop',
  coordinated: 'decides who goes first, not when: arms pause on their way for each other',
};

export function PolicyForm({ app }: { app: App }) {
  const { store } = app;
  const [chosen, set_chosen] = useState<string | null>(null);
  const policy = chosen ?? store.policy;
  const mute = why_no_command(app) ?? why_no_change(store);
  return (
    <form
      data-test="policy-form"
      onSubmit={(event) => {
        event.preventDefault();
        void app.actions.change_policy(policy).then(() => set_chosen(null));
      }}
    >
      <fieldset class="choices stacked">
        <legend>Who passes first is decided by</legend>
        {Object.entries(kPolicies).map(([name, what]) => (
          <label key={name}>
            <input type="radio" name="policy" value={name} checked={policy === name} onChange={() => set_chosen(name)} />
            <span><b>{name}</b>: {what}</span>
          </label>
        ))}
      </fieldset>
      <button data-test="change-policy" disabled={mute !== null || policy === store.policy} title={mute ?? ''}>
        {policy === store.policy ? 'In force' : `Change to ${policy}`}
      </button>
      <p class="hint">
        {mute === null ? 'Possible while no job is admitted.' : <b data-test="no-change">{mute}.</b>} Jobs that wait are judged anew. It lasts until the server is
        started again: the cell file sets it for good.
      </p>
    </form>
  );
}
