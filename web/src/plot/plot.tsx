// A plot of joints over time. uPlot is loaded when the first plot is shown. Measured values come
// from the page's trace (state/trace.ts).

import { useEffect, useRef } from 'preact/hooks';
import type { App } from '../state/app';
import type { Motion } from '../motion/motion';
import type { Chart, Planned } from './chart';

const kRenew_ms = 400;

interface Props {
  app: App;
  joints: readonly string[];
  label: string;
  /** If given instead of `stretch`, the last `last_s` seconds are shown. */
  last_s?: number;
  /** The shown range in cell time. Its end is null while the motion continues. */
  stretch?: readonly [from_s: number, to_s: number | null];
  /** The planned motion. It is drawn from the beginning of `stretch`. */
  planned?: Motion | null;
}

const kPlannedPoints = 160;

function planned_of(motion: Motion, joints: readonly string[], from_s: number): Planned {
  const t_s = Array.from({ length: kPlannedPoints }, (_, i) => (motion.duration_s * i) / (kPlannedPoints - 1));
  const states = t_s.map((at_s) => motion.q_at(at_s));
  return { t_s: t_s.map((at_s) => from_s + at_s), q: joints.map((joint) => states.map((q) => q[joint] ?? null)) };
}

/** Returns the unit of the vertical axis. */
export function units_of(joints: readonly string[], { store }: App): string {
  const units = store.cell?.joints.flatMap(({ name, unit }) => (joints.includes(name) ? [unit] : [])) ?? [];
  return [...new Set(units)].join(' and ') || 'rad';
}

export function Plot({ app, joints, label, last_s, stretch, planned }: Props) {
  const host = useRef<HTMLDivElement>(null);
  const { store, settings } = app;
  const theme = settings.shown_theme.value;
  const [from_s, to_s] = stretch ?? [null, null];
  const names = joints.join('\n');
  useEffect(() => {
    let chart: Chart | null = null;
    const meant = planned ? planned_of(planned, joints, from_s ?? 0) : null;
    let closed = false;
    const show = () => {
      const end_s = to_s ?? store.t_s;
      const begin_s = from_s ?? Math.max(0, end_s - (last_s ?? 20));
      const last_s_shown = Math.max(end_s, begin_s + (planned ? planned.duration_s : 1));
      chart?.show(store.trace.between(joints, begin_s, end_s), [begin_s, last_s_shown], meant);
    };
    void import('./chart').then((module) => {
      if (closed || !host.current) return;
      chart = new module.Chart(host.current, joints, meant !== null);
      show();
    });
    const timer = setInterval(() => { if (to_s === null) show(); }, kRenew_ms);
    return () => {
      closed = true;
      clearInterval(timer);
      chart?.close();
    };
  }, [store, names, theme, from_s, to_s, last_s, planned]);
  return <div ref={host} class="plot" role="img" aria-label={label} data-test="plot" />;
}
