// Shows the scheduling policy, and changes it while no job is admitted.

import { useState } from 'preact/hooks';
import type { Cell } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { why_no_change } from '../policies/change';
import { kText } from '../strings';

const kWords = kText.policies;type Policy = Cell['scheduling']['policy'];
const kPolicies: Record<Policy, string> = kWords.what;

export function PolicyForm({ app }: { app: App }) {
  const { store } = app;
  const [chosen, set_chosen] = useState<string | null>(null);
  const policy = chosen ?? store.policy;
  const why_disabled = why_no_command(app) ?? why_no_change(store);
  return (
    <form
      data-test="policy-form"
      onSubmit={(event) => {
        event.preventDefault();
        void app.actions.change_policy(policy).then(() => set_chosen(null));
      }}
    >
      <fieldset class="choices stacked">
        <legend>{kWords.choose}</legend>
        {Object.entries(kPolicies).map(([name, what]) => (
          <label key={name}>
            <input type="radio" name="policy" value={name} checked={policy === name} onChange={() => set_chosen(name)} />
            <span><b>{name}</b>: {what}</span>
          </label>
        ))}
      </fieldset>
      <button data-test="change-policy" disabled={why_disabled !== null || policy === store.policy} title={why_disabled ?? ''}>
        {policy === store.policy ? kWords.active : kWords.change_to(policy)}
      </button>
      <p class="hint">
        {why_disabled === null ? kWords.change_hint : <b data-test="no-change">{why_disabled}.</b>}{kWords.change_effect}
      </p>
    </form>
  );
}
