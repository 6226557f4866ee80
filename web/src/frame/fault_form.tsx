// Injects faults into simulated arms, and lists and removes the present faults of all clients.

import { useEffect, useState } from 'preact/hooks';
import type { Cell, FaultKind } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { kText } from '../strings';
import { FaultList } from './fault_list';
import { fault_in_words, kKinds, may_last, request_of, simulated_arms, value_of } from './fault_request';
import { NumberField } from './number_field';

const kWords = kText.faults;
const kRefresh_ms = 2000;

export function Faults({ app, cell }: { app: App; cell: Cell }) {
  const [faults] = useState(() => new FaultList(app.api));
  const is_open = app.store.link.status === 'open';
  useEffect(() => {
    if (!is_open) return;
    void faults.refresh();
    const timer = setInterval(() => void faults.refresh(), kRefresh_ms);
    return () => clearInterval(timer);
  }, [faults, is_open]);
  const arms = simulated_arms(cell);
  return (
    <>
      <h2>{kWords.title}</h2>
      {arms.length > 0 ? <FaultForm app={app} arms={arms} faults={faults} /> : <p class="hint" data-test="no-faults">{kWords.none_simulated}</p>}
      {faults.all.length > 0 && <Listed app={app} faults={faults} />}
    </>
  );
}

function FaultForm({ app, arms, faults }: { app: App; arms: readonly string[]; faults: FaultList }) {
  const [chosen, set_arm] = useState<string | null>(null);
  const [kind, set_kind] = useState<FaultKind>('stall');
  const [value, set_value] = useState('');
  const [for_s, set_for_s] = useState('');
  const arm = chosen ?? arms[0] ?? '';
  const request = request_of(arm, kind, value, for_s);
  const why_disabled = why_no_command(app) ?? (request === null ? kWords.not_a_number : null);
  const choose = (next: FaultKind) => {
    set_kind(next);
    set_value(String(value_of(next)?.usual ?? ''));
  };
  const inject = async () => {
    if (request !== null) await app.actions.ask(kText.command.inject(kind, arm), faults.inject(request));
  };
  return (
    <form class="fault-form" data-test="fault-form" onSubmit={(event) => { event.preventDefault(); void inject(); }}>
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
    </form>
  );
}

function Listed({ app, faults }: { app: App; faults: FaultList }) {
  const why_disabled = why_no_command(app);
  const remove = (id: string) => app.actions.ask(kText.command.remove_fault(id), faults.remove(id));
  return (
    <>
      <h3>{faults.is_whole ? kWords.present : kWords.injected}</h3>
      <ul class="fault-list" data-test="injected-faults">
        {faults.all.map((fault) => (
          <li key={fault.id}>{fault_in_words(fault)} <button class="small" disabled={why_disabled !== null} title={why_disabled ?? ''} onClick={() => void remove(fault.id)}>{kWords.remove}</button></li>
        ))}
      </ul>
    </>
  );
}
