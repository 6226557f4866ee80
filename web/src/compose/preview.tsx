// Previews a motion as a ghost in the 3D view. The motion is played, or shown at a chosen time.

import { useEffect, useState } from 'preact/hooks';
import type { App } from '../state/app';
import type { Motion } from '../motion/motion';
import { kText } from '../strings';

const kStep_ms = 66;

/**
 * A time to show, chosen elsewhere on the page, such as the time of a conflict. Each choice is a
 * new object.
 */
export interface Chosen { t_s: number }

export function Preview({ motion, app, chosen }: { motion: Motion; app: App; chosen: Chosen | null }) {
  const [t_s, set_t_s] = useState(0);
  const [plays, set_plays] = useState(false);
  const end_s = motion.duration_s;
  const show = (next_s: number) => {
    set_t_s(next_s);
    app.ghost.value = motion.q_at(next_s);
  };
  useEffect(() => {
    if (!chosen) return;
    set_plays(false);
    show(Math.min(chosen.t_s, end_s));
  }, [chosen, motion]);
  useEffect(() => () => { app.ghost.value = null; }, [app]);
  useEffect(() => {
    if (!plays) return;
    const timer = setInterval(() => set_t_s((now_s) => {
      const next_s = Math.min(end_s, now_s + kStep_ms / 1000);
      app.ghost.value = motion.q_at(next_s);
      if (next_s >= end_s) set_plays(false);
      return next_s;
    }), kStep_ms);
    return () => clearInterval(timer);
  }, [plays, motion, app]);
  return (
    <div class="line preview">
      <button class="small" data-test="preview" aria-pressed={plays} onClick={() => { if (!plays && t_s >= end_s) show(0); set_plays(!plays); }}>
        {plays ? kText.common.pause : kText.compose.preview}
      </button>
      <input class="grow" type="range" min={0} max={end_s} step={0.02} value={t_s} aria-label={kText.compose.preview_time} aria-valuetext={`${t_s.toFixed(2)} s`}
        data-test="preview-time" onInput={(event) => { set_plays(false); show(Number(event.currentTarget.value)); }} />
      <span class="mono small">{t_s.toFixed(2)} / {end_s.toFixed(2)} s</span>
    </div>
  );
}
