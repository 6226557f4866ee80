// Injects faults into simulated arms, and removes them.

import { useState } from 'preact/hooks';
import type { Cell, Fault, FaultKind } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { kText } from '../strings';
import { kKinds, may_last, request_of, simulated_arms, value_of } from './fault_request';
import { NumberField } from './number_field';

const kWords = kText.faults;

export function FaultForm({ app, cell }: { app: App; cell: Cell }) {
  const arms = simulated_arms(cell);
  const [chosen, set_arm] = useState<string | null>(null);
  const [kind, set_kind] = useState<FaultKind>('stall');
  const [value, set_value] = useState('');
  const [for_s, set_for_s] = useState('');
  const [faults, set_faults] = useState<readonly Fault[]>([]);
  const arm = chosen ?? arms[0] ?? '';
  const request = request_of(arm, kind, value, for_s);
  const why_disabled = why_no_command(app) ?? (request === null ? kWords.not_a_number : null);
  const choose = (next: FaultKind) => {
    set_kind(next);
    set_value(String(value_of(next)?.usual ?? ''));
  };
  const inject = async () => {
    if (request === null) return;
    const answer = app.api.inject(request);
    await app.actions.ask(kText.command.inject(kind, arm), answer);
    const got = await answer;
    if (got.ok) set_faults((before) => [...before, got.value]);
  };
  const remove = async (id: string) => {
    await app.actions.ask(kText.command.remove_fault(id), app.api.remove_fault(id));
    set_faults((before) => before.filter((fault) => fault.id !== id));
  };
  if (arms.length === 0) return <><h2>{kWords.title}</h2><p class="hint" data-test="no-faults">{kWords.none_simulated}</p></>;
  return (
    <form data-test="fault-form" onSubmit={(event) => { event.preventDefault(); void inject(); }}>
      <h2>{kWords.title}</h2>
      <p class="hint">{kWords.hint}</p>
      <label>{kWords.arm} <select value={arm} data-test="fault-arm" onChange={(event) => set_arm(event.currentTarget.value)}>
        {arms.map((name) => <option key={name} value={name}>{name}</option>)}
      </select></label>
      <label>{kWords.kind} <select value={kind} data-test="fault-kind" onChange={(event) => choose(event.currentTarget.value as FaultKind)}>
        {Object.entries(kKinds).map(([name, what]) => <option key={name} value={name}>{name}: {what}</option>)}
      </select></label>
      {value_of(kind) && (
        <label>{kWords.value}, {value_of(kind)?.unit} <NumberField value={value} step={0.01} test="fault-value" narrow change={set_value} /></label>
      )}
      {may_last(kind) && (
        <label>{kWords.for_s} <input type="text" class="narrow" autocomplete="off" value={for_s} data-test="fault-for" onInput={(event) => set_for_s(event.currentTarget.value)} /></label>
      )}
      <button data-test="inject-fault" disabled={why_disabled !== null} title={why_disabled ?? ''}>{kWords.inject}</button>
      {faults.length > 0 && (
        <>
          <h3>{kWords.injected}</h3>
          <ul data-test="injected-faults">
            {faults.map(({ id, kind: name, arm: of }) => (
              <li key={id}>{kWords.entry(name, of)} <button type="button" class="small" onClick={() => void remove(id)}>{kWords.remove}</button></li>
            ))}
          </ul>
        </>
      )}
    </form>
  );
}
