// Joints over time, drawn by uPlot, which is loaded when the first plot is shown. Measured values come
// from what the page has heard; a stretch of cell time, or the last so many seconds.

import { useEffect, useRef } from 'preact/hooks';
import type { App } from '../state/app';
import type { Chart } from './chart';

const kRenew_ms = 400;

interface Props {
  app: App;
  joints: readonly string[];
  label: string;
  /** The last so many seconds; or `stretch`. */
  last_s?: number;
  /** From, to; to is null while it goes on. Cell time. */
  stretch?: readonly [from_s: number, to_s: number | null];
}

export function Plot({ app, joints, label, last_s, stretch }: Props) {
  const host = useRef<HTMLDivElement>(null);
  const { store, settings } = app;
  const theme = settings.shown_theme.value;
  const [from_s, to_s] = stretch ?? [null, null];
  const names = joints.join('\n');
  useEffect(() => {
    let chart: Chart | null = null;
    let closed = false;
    const show = () => {
      const end_s = to_s ?? store.t_s;
      const begin_s = from_s ?? Math.max(0, end_s - (last_s ?? 20));
      chart?.show(store.trace.between(joints, begin_s, end_s), [begin_s, Math.max(end_s, begin_s + 1)]);
    };
    void import('./chart').then((module) => {
      if (closed || !host.current) return;
      chart = new module.Chart(host.current, joints);
      show();
    });
    const timer = setInterval(() => { if (to_s === null) show(); }, kRenew_ms);
    return () => {
      closed = true;
      clearInterval(timer);
      chart?.close();
    };
  }, [store, names, theme, from_s, to_s, last_s]);
  return <div ref={host} class="plot" role="img" aria-label={label} data-test="plot" />;
}
