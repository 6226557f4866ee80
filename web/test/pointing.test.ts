import { describe, expect, it, vi } from 'vitest';
import type { App } from '../src/state/app';
import type { EventMark } from '../src/timeline/events';
import type { Lane, Mark } from '../src/timeline/lanes';
import { kNothing, pointing, type Drawing, type Tip } from '../src/timeline/pointing';
import { kAxis_px, kLeft_px, kRight_px, sheet_of } from '../src/timeline/sheet';
import { kFollowing, kNowAt, type Span } from '../src/timeline/span';

const kNow_s = 100;
const kWidth = kLeft_px + kRight_px + 500;  // 10 px per second
const kHeight = 2 * 54 + kAxis_px;
const kLane_px = 20;

const motion: Mark = { kind: 'motion', expected: false, job: 'pick', label: 'pick', state: 'running', from_s: 70, to_s: 90, waits_on: null, stopped: false };
const stop: EventMark = { key: 1, t_s: 95, level: 'warning', text: 'stopped', arms: [] };

/** Returns a timeline of 50 s that follows now, and the page that a click opens. */
function timeline() {
  const drawing: Drawing = {
    span: kFollowing, lanes: [{ arm: 'left', marks: [motion], waiting: 0 }, { arm: 'right', marks: [], waiting: 0 }] as Lane[],
    sheet: sheet_of(kWidth, kHeight, kFollowing, kNow_s), pointed: kNothing, drag: null,
  };
  const seen = { spans: [] as Span[], tips: [] as (Tip | null)[], draws: 0, went: [] as unknown[], held: [] as unknown[] };
  const app = { store: { t_s: kNow_s, events: [stop] }, router: { go: (place: unknown) => seen.went.push(place), show_time: (t_s: unknown) => seen.held.push(t_s) } } as unknown as App;
  const on = pointing(drawing, app, (span) => seen.spans.push(span), (tip) => seen.tips.push(tip), () => { seen.draws += 1; });
  const canvas = { setPointerCapture: vi.fn(), classList: { toggle: vi.fn() } };
  const at = (t_s: number, y = kLane_px, over = {}) => ({ offsetX: drawing.sheet?.x(t_s), offsetY: y, pointerId: 1, currentTarget: canvas, preventDefault: vi.fn(), ...over }) as unknown as PointerEvent & WheelEvent;
  return { drawing, seen, on, at, canvas };
}

describe('Pointer on the timeline', () => {
  it('shows what is under it', () => {
    const { seen, on, at, canvas } = timeline();
    on.onPointerMove(at(80));
    expect(seen.tips.at(-1)?.words).toMatch(/pick/);
    expect(canvas.classList.toggle).toHaveBeenLastCalledWith('leads', true);
    on.onPointerMove(at(80, kLane_px + 54));
    expect(seen.tips.at(-1)).toBeNull();
    expect(canvas.classList.toggle).toHaveBeenLastCalledWith('leads', false);
  });

  it('opens a job by a click, also with small movements', () => {
    const { seen, on, at } = timeline();
    on.onPointerDown(at(80));
    on.onPointerMove(at(80.3));
    on.onPointerUp(at(80.3));
    expect(seen.went).toEqual([{ page: 'job', id: 'pick' }]);
    expect(seen.spans).toEqual([]);
  });

  it('goes to an event by a click on its mark', () => {
    const { seen, on, at } = timeline();
    on.onPointerDown(at(95, kHeight - kAxis_px - 3));
    on.onPointerUp(at(95, kHeight - kAxis_px - 3));
    expect([seen.held, seen.went]).toEqual([[95], []]);
  });

  it('drags the sheet by its movement, and opens nothing on release', () => {
    const { seen, on, at } = timeline();
    on.onPointerDown(at(60));
    on.onPointerMove(at(65));
    on.onPointerMove(at(80));
    on.onPointerUp(at(80));
    const follows_from_s = kNow_s - kNowAt * kFollowing.length_s;
    expect(seen.spans.map(({ fixed_from_s }) => fixed_from_s)).toEqual([follows_from_s - 5, follows_from_s - 20]);
    expect(seen.went).toEqual([]);
  });

  it('opens nothing after a press elsewhere or a cancel', () => {
    const { seen, on, at } = timeline();
    on.onPointerUp(at(80));
    on.onPointerDown(at(80));
    on.onPointerCancel();
    on.onPointerUp(at(80));
    expect([seen.went, seen.held]).toEqual([[], []]);
  });

  it('zooms about itself with the wheel once the range is fixed', () => {
    const { drawing, seen, on, at } = timeline();
    drawing.span = { length_s: 50, fixed_from_s: 62.5 };
    on.onWheel(at(80, kLane_px, { deltaY: -1 }));
    const [near] = seen.spans;
    expect(near?.length_s).toBeCloseTo(50 / 1.2, 9);
    expect((near?.fixed_from_s ?? 0) + 0.35 * (near?.length_s ?? 0)).toBeCloseTo(80, 9);  // the pointed time stays in its place, at 17.5 of 50 s
    on.onWheel(at(80, kLane_px, { deltaY: 1 }));
    expect(seen.spans.at(-1)?.length_s).toBeCloseTo(60, 9);
  });

  it('shows nothing after leaving', () => {
    const { drawing, seen, on, at } = timeline();
    on.onPointerMove(at(80));
    on.onPointerLeave();
    expect([drawing.pointed, seen.tips.at(-1)]).toEqual([kNothing, null]);
  });
});
