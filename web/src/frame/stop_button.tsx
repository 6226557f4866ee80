// Stop: one place, one key. It is never disabled: a page that hears nothing can still ask.

import type { App } from '../state/app';
import { is_viewer } from '../state/permission';

/** What it does, as IEC 60204-1 has it: category 2; this is no emergency stop. */
export const kStopName = 'Stop all: controlled, drives stay powered';
export const kStopKey = 'F8';

export function StopButton({ app }: { app: App }) {
  const asked = app.actions.stopping.value;
  const in_vain = is_viewer(app.session.value);
  return (
    <button class="stop" aria-label={kStopName} aria-keyshortcuts={kStopKey} data-test="stop"
      title={in_vain ? 'Your token may only look: the server will refuse it. Use the cell\'s own stop.' : `Brakes all arms on their paths. Key ${kStopKey}. Not an emergency stop.`}
      onClick={() => void app.actions.stop()}>
      <span class="stop-what"><b>{asked ? 'Stopping…' : 'Stop all'}</b><span class="stop-how">{in_vain ? 'not with your token' : 'controlled, drives stay powered'}</span></span>
      <kbd>{kStopKey}</kbd>
    </button>
  );
}
