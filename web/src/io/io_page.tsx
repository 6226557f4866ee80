// The I/O page: all inputs and outputs of the cell, and controls to set those that can be set.

import { useState } from 'preact/hooks';
import { AsOf } from '../frame/as_of';
import { NumberField } from '../frame/number_field';
import { shown_name, shown_text } from '../names';
import type { Signal, SignalValue } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { kText } from '../strings';

const kWords = kText.io;

export function IoPage({ app }: { app: App }) {
  const { signals } = app.store;
  return (
    <div class="page">
      <h2>{kText.page.io}<span class="count">{signals.length}</span></h2>
      {app.router.address.value.t_s === null ? <p class="hint">{signals.length === 0 ? kWords.none : kWords.hint}</p> : <AsOf app={app}>{kWords.past}</AsOf>}
      <table class="signals" data-test="signals">
        {signals.map((signal) => <Row key={signal.name} signal={signal} app={app} />)}
      </table>
    </div>
  );
}

function Row({ signal, app }: { signal: Signal; app: App }) {
  const why_disabled = why_not_set(signal) ?? why_no_command(app);
  const set = (value: SignalValue) => void app.actions.set_signal(signal.name, value);
  const value = signal.commanded ?? signal.value;
  return (
    <tr data-test={`signal-${signal.name}`}>
      <td class="grow"><span class="ellipsis" title={shown_name(signal.name)}>{shown_name(signal.name)}</span>
        <span class="dim small below">{signal.device === null ? kWords.simulated(signal.direction) : kWords.of_device(signal.direction, shown_name(signal.device))}</span>
        {!signal.is_connected && <span class="small below warn" data-test="signal-lost">{kWords.not_connected(shown_text(signal.detail ?? ''))}</span>}
      </td>
      <td class="mono" data-test="signal-value">{value_in_words(signal.value)}{signal.commanded !== undefined && <span class="dim"> → {value_in_words(signal.commanded)}</span>}</td>
      <td>{signal.type === 'bool'
        ? <button class="small" role="switch" aria-checked={value === true} aria-label={shown_name(signal.name)} disabled={why_disabled !== null} title={why_disabled ?? ''} onClick={() => set(value !== true)}>{value === true ? kWords.switch_off : kWords.switch_on}</button>
        : <Register value={value} why_disabled={why_disabled} set={set} />}</td>
    </tr>
  );
}

function Register({ value, why_disabled, set }: { value: SignalValue | null; why_disabled: string | null; set(value: number): void }) {
  const [text, set_text] = useState(String(value ?? 0));
  return (
    <form class="line" onSubmit={(event) => { event.preventDefault(); set(Number(text)); }}>
      <NumberField value={text} step={1} test="register" change={set_text} />
      <button class="small" type="submit" disabled={why_disabled !== null || text === ''} title={why_disabled ?? ''}>{kWords.set}</button>
    </form>
  );
}

function why_not_set({ device, direction, is_connected, detail }: Signal): string | null {
  if (device !== null && direction === 'input') return kWords.read_only;
  return is_connected ? null : kWords.not_connected(shown_text(detail ?? ''));
}

function value_in_words(value: SignalValue | null | undefined): string {
  if (value === null || value === undefined) return kWords.unknown;
  return typeof value === 'boolean' ? (value ? kWords.on : kWords.off) : String(value);
}
