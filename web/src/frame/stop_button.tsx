// The Stop button. It is never disabled, because a page that receives nothing may still be able to
// send.

import type { App } from '../state/app';
import { is_viewer } from '../state/permission';
import { kText } from '../strings';

const kWords = kText.frame;

/** A controlled stop of category 2 (IEC 60204-1), not an emergency stop. */
export const kStopName = `${kWords.stop_all}: ${kWords.stop_how}`;
export const kStopKey = 'F8';

export function StopButton({ app }: { app: App }) {
  const asked = app.actions.stopping.value;
  const not_allowed = is_viewer(app.session.value);
  return (
    <button class="stop" aria-label={kStopName} aria-keyshortcuts={kStopKey} data-test="stop"
      title={not_allowed ? kWords.stop_not_allowed_title : kWords.stop_title(kStopKey)}
      onClick={() => void app.actions.stop()}>
      <span class="stop-what"><b>{asked ? kWords.stopping : kWords.stop_all}</b><span class="stop-how">{not_allowed ? kWords.stop_not_allowed : kWords.stop_how}</span></span>
      <kbd>{kStopKey}</kbd>
    </button>
  );
}
