// The scrub bar sets the time that all views show. At its right end the views follow now.

import { useEffect, useState } from 'preact/hooks';
import type { App } from '../state/app';
import { instant_of } from '../state/instant';
import { use_beats } from '../state/seen';
import { kText } from '../strings';
import { clock } from '../wording';

const kWords = kText.timeline;

const kStep_s = 0.1;
const kPlayed_ms = 66;

export function ScrubBar({ app }: { app: App }) {
  use_beats(app.store);
  const { span } = app.store;
  const shown_s = app.router.address.value.t_s;
  const is_recording = app.store.link.status === 'recording';
  // A recording without positions has no pose at any time. The scrub bar then shows the times of
  // its events.
  const unheard = !is_recording && instant_of(app.router.address.value, app.store).kind === 'unheard';
  if (!span || span.last_s - span.first_s < 1) return null;
  const { first_s, last_s } = span;
  const value_s = Math.min(last_s, Math.max(first_s, shown_s ?? last_s));
  const words = shown_s === null ? kWords.scrub_now : unheard ? kWords.no_data_at(clock(shown_s)) : kWords.ago(clock(shown_s), (last_s - shown_s).toFixed(1));
  return (
    <>
      {shown_s !== null && !unheard && <Play app={app} />}
      <label class="scrub" title={kWords.scrub_title}>
        <span class="sr-only">{kWords.scrub}</span>
        <span class="small mono">{shown_s === null ? '' : unheard ? kWords.no_data : kWords.offset((last_s - value_s).toFixed(1))}</span>
        <input type="range" min={first_s} max={last_s} step={kStep_s} value={value_s} aria-valuetext={words} data-test="scrub"
          onInput={(event) => {
            const t_s = Number(event.currentTarget.value);
            app.router.show_time(t_s >= last_s - kStep_s && !is_recording ? null : t_s);
          }} />
      </label>
    </>
  );
}

/** Plays from the shown time to the end, at the recorded speed. */
function Play({ app }: { app: App }) {
  const [plays, set_plays] = useState(false);
  useEffect(() => {
    if (!plays) return;
    let before_ms = performance.now();
    const timer = setInterval(() => {
      const now_ms = performance.now();
      const t_s = (app.router.address.peek().t_s ?? 0) + (now_ms - before_ms) / 1000;
      const last_s = app.store.span?.last_s ?? 0;
      before_ms = now_ms;
      app.router.show_time(Math.min(t_s, last_s));
      if (t_s >= last_s) set_plays(false);
    }, kPlayed_ms);
    return () => clearInterval(timer);
  }, [plays, app]);
  return <button class="small" data-test="play" aria-pressed={plays} title={kWords.play_title} onClick={() => set_plays(!plays)}>{plays ? kText.common.pause : kText.common.play}</button>;
}
