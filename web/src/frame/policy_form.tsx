// Which policy decides, and another one while no job is admitted.

import { useState } from 'preact/hooks';
import type { Cell } from '../server/messages';
import type { App } from '../state/app';
import { why_no_change } from '../policies/change';
import { why_mute } from '../wording';

type Policy = Cell['scheduling']['policy'];
const kPolicies: Record<Policy, string> = {
  sequential: 'one job at a time in the whole cell',
  lockstep: 'rounds of one job for each arm',
  reservation: 'a motion has all that it sweeps to itself',
  timed_discrete: "the paper's: equal instants compared; nothing is promised between them",
  certified: 'a start now that is proven to pass all others without a stop, or none',
  earliest_start: 'the earliest start that is proven to pass all others without a stop',
  coordinated: 'orders instead of times: arms pause on their way for each other',
};

export function PolicyForm({ app }: { app: App }) {
  const { store } = app;
  const [chosen, set_chosen] = useState<string | null>(null);
  const policy = chosen ?? store.policy;
  const mute = why_mute(store.link) ?? why_no_change(store);
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
        {mute !== null && <b data-test="no-change">{mute}. </b>}Only while no job is admitted; jobs that wait are judged anew. Until the next start of the server: a cell
        file says for good.
      </p>
    </form>
  );
}
