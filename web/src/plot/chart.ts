// A uPlot chart in the page's colors. Joints differ in color and also in dash pattern, for readers
// who do not see colors.

import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { short_names } from '../names';
import { ink } from '../state/palette';
import type { Curves } from '../state/trace';
import { clock } from '../wording';

const kHeight_px = 170;
const kColors = 8;
const kDashes: readonly number[][] = [[], [8, 3], [2, 3], [10, 3, 2, 3]];
const kBorders = ['solid', 'dashed', 'dotted', 'double'];

/**
 * The planned positions `q` of each joint at the times `t_s`. A position is null where there is no
 * plan.
 */
export interface Planned { t_s: number[]; q: (number | null)[][] }

export class Chart {
  private readonly plot_: uPlot;
  private readonly observer_: ResizeObserver;

  /** If `with_plan` is true, the plan is drawn as a broad, pale band under the measured line. */
  constructor(host: HTMLElement, joints: readonly string[], with_plan: boolean) {
    const series = with_plan ? 2 * joints.length : joints.length;
    this.plot_ = new uPlot(options_of(joints, host.clientWidth, with_plan), [[], ...Array.from({ length: series }, () => [])], host);
    this.observer_ = new ResizeObserver(() => {
      if (host.clientWidth > 0) this.plot_.setSize({ width: host.clientWidth, height: kHeight_px });
    });
    this.observer_.observe(host);
  }

  show({ t_s, q }: Curves, [min, max]: readonly [number, number], planned: Planned | null): void {
    const data = planned ? uPlot.join([[planned.t_s, ...planned.q], [t_s, ...q]]) : [t_s, ...q] as uPlot.AlignedData;
    this.plot_.batch(() => {
      this.plot_.setData(data, false);
      const values = [...q.flat(), ...(planned?.q.flat() ?? [])].filter((value): value is number => value !== null && Number.isFinite(value));
      const [low, high] = [Math.min(...values, Infinity), Math.max(...values, -Infinity)];
      const edge = Math.max(0.05, 0.06 * (high - low));
      this.plot_.setScale('x', { min, max });
      if (low <= high) this.plot_.setScale('y', { min: low - edge, max: high + edge });
    });
  }

  close(): void {
    this.observer_.disconnect();
    this.plot_.destroy();
  }
}

function options_of(joints: readonly string[], width: number, with_plan: boolean): uPlot.Options {
  const axis = { stroke: ink('--dim'), grid: { stroke: ink('--line'), width: 1 }, ticks: { stroke: ink('--line'), width: 1 }, font: '10.5px "Inter Variable", system-ui' };
  const labels = short_names(joints);
  return {
    width, height: kHeight_px,
    scales: { x: { time: false } },
    axes: [
      { ...axis, size: 26, values: (_, ticks) => ticks.map((t_s) => clock(t_s).replace(/^0:/, '')) },
      { ...axis, size: 44, values: (_, ticks) => ticks.map((q) => String(Number(q.toPrecision(4)))) },
    ],
    series: [
      { label: 'at', value: (_, t_s) => (t_s === null ? '' : clock(t_s)) },
      ...(with_plan ? joints.map((joint, i) => ({
        label: `${joint} planned`, class: 'planned', width: 6, points: { show: false }, spanGaps: true, stroke: `${ink(`--arm-${i % kColors}`)}44`,
      })) : []),
      ...joints.map((joint, i) => ({
        spanGaps: with_plan, label: labels[i] ?? joint, width: 1.5, points: { show: false },
        stroke: ink(`--arm-${i % kColors}`), dash: kDashes[i % kDashes.length] ?? [],
        value: (_: uPlot, q: number | null) => (q === null ? '' : q.toFixed(3)),
      })),
    ],
    // uPlot's series 0 is time, so the joints begin at series 1.
    legend: { show: true, live: true, markers: { width: 2, dash: (_, i) => kBorders[(i - 1 - (with_plan ? joints.length : 0)) % kBorders.length] ?? 'solid' } },
    cursor: { drag: { setScale: false, x: false, y: false } },
  };
}
