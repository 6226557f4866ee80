// A chart of uPlot's in the page's colours, as wide as its place. Each joint has a colour and, as colours
// repeat or are not told apart by everybody, a dash of its own.

import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { ink } from '../state/palette';
import type { Curves } from '../state/trace';
import { clock } from '../wording';

const kHeight_px = 170;
const kColours = 8;
const kDashes: readonly number[][] = [[], [8, 3], [2, 3], [10, 3, 2, 3]];
const kBorders = ['solid', 'dashed', 'dotted', 'double'];

export class Chart {
  private readonly plot_: uPlot;
  private readonly observer_: ResizeObserver;

  constructor(host: HTMLElement, joints: readonly string[]) {
    this.plot_ = new uPlot(options_of(joints, host.clientWidth), [[], ...joints.map(() => [])], host);
    this.observer_ = new ResizeObserver(() => {
      if (host.clientWidth > 0) this.plot_.setSize({ width: host.clientWidth, height: kHeight_px });
    });
    this.observer_.observe(host);
  }

  show({ t_s, q }: Curves, [min, max]: readonly [number, number]): void {
    this.plot_.batch(() => {
      this.plot_.setData([t_s, ...q], false);
      const values = q.flat().filter(Number.isFinite);
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

function options_of(joints: readonly string[], width: number): uPlot.Options {
  const axis = { stroke: ink('--dim'), grid: { stroke: ink('--line'), width: 1 }, ticks: { stroke: ink('--line'), width: 1 }, font: '10.5px "Inter Variable", system-ui' };
  return {
    width, height: kHeight_px,
    scales: { x: { time: false } },
    axes: [
      { ...axis, size: 26, values: (_, ticks) => ticks.map((t_s) => clock(t_s).replace(/^0:/, '')) },
      { ...axis, size: 44, values: (_, ticks) => ticks.map((q) => String(Number(q.toPrecision(4)))) },
    ],
    series: [
      { label: 'at', value: (_, t_s) => (t_s === null ? '' : clock(t_s)) },
      ...joints.map((joint, i) => ({
        label: joint.replace(/^.*_(?=joint)/, ''), width: 1.5, points: { show: false },
        stroke: ink(`--arm-${i % kColours}`), dash: kDashes[i % kDashes.length] ?? [],
        value: (_: uPlot, q: number | null) => (q === null ? '' : q.toFixed(3)),
      })),
    ],
    // Series are counted from one: the first is time.
    legend: { show: true, live: true, markers: { width: 2, dash: (_, i) => kBorders[(i - 1) % kBorders.length] ?? 'solid' } },
    cursor: { drag: { setScale: false, x: false, y: false } },
  };
}
