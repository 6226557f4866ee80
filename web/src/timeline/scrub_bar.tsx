// One bar for all views: where it stands is the instant that the cell, the timeline and the address
// show; at its right end they follow now.

import type { App } from '../state/app';
import { use_store } from '../state/use_store';
import { clock } from '../wording';

const kStep_s = 0.1;

export function ScrubBar({ app }: { app: App }) {
  use_store(app.store, 'live');
  const { trace } = app.store;
  const held_s = app.router.address.value.t_s;
  const first_s = trace.first_s ?? 0;
  const last_s = trace.last_s ?? 0;
  if (last_s - first_s < 1) return null;
  const value_s = Math.min(last_s, Math.max(first_s, held_s ?? last_s));
  const words = held_s === null ? 'now' : `${clock(held_s)}, ${(last_s - held_s).toFixed(1)} s ago`;
  return (
    <label class="scrub" title="Look back: drag, or use the arrow keys">
      <span class="sr-only">Look back</span>
      <span class="small mono">{held_s === null ? '' : `−${(last_s - value_s).toFixed(1)} s`}</span>
      <input type="range" min={first_s} max={last_s} step={kStep_s} value={value_s} aria-valuetext={words} data-test="scrub"
        onInput={(event) => {
          const t_s = Number(event.currentTarget.value);
          app.router.hold_at(t_s >= last_s - kStep_s ? null : t_s);
        }} />
    </label>
  );
}
