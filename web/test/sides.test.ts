import { describe, expect, it } from 'vitest';
import { measured_path } from '../src/diagram/reading';
import { job_of_side, why_no_pair } from '../src/diagram/sides';
import type { Job } from '../src/server/messages';
import { JobBook, type JobList } from '../src/state/job_book';
import { progress_at, ProgressBook } from '../src/state/progress_book';
import { job_json } from './samples';

const known = (...jobs: Job[]) => {
  const book = new JobBook();
  book.reset(jobs, 0, false);
  return { job: (id: string) => book.get(id), jobs: (list: JobList) => book.list(list), arms: new Map(['left', 'right', 'front'].map((name) => [name, null])) };
};
const job = (id: string, arms: string[], state: string, over: object = {}) => job_json(id, { arms, state, ...over }) as Job;

describe('Side of a diagram', () => {
  it('is a job, or the current, next or last job of an arm', () => {
    const store = known(
      job('old', ['left'], 'succeeded', { ended_s: 3 }), job('older', ['left'], 'succeeded', { ended_s: 2 }),
      job('waits', ['right'], 'backlogged'), job('runs', ['right'], 'running'));
    expect(job_of_side('waits', store)?.id).toBe('waits');
    expect(job_of_side('right', store)?.id).toBe('runs');
    expect(job_of_side('left', store)?.id).toBe('old');
    expect(job_of_side('front', store)).toBeNull();
    expect(why_no_pair('left', 'right', store)).toBeNull();
    expect(why_no_pair('left', 'front', store)).toMatch(/front has had no job yet/);
    expect(why_no_pair('old', 'older', store)).toMatch(/same arm/);
    expect(why_no_pair('left', 'left', store)).toMatch(/choose another/);
    // The server may know a job that the page does not.
    expect(why_no_pair('left', 'forgotten', store)).toBeNull();
  });

  it('is the job if an arm has the same name, and none if one job moves both', () => {
    const store = known(job('left', ['right'], 'running'), job('both', ['left', 'front'], 'running'));
    expect(job_of_side('left', store)?.arms).toEqual(['right']);
    expect(why_no_pair('front', 'both', store)).toMatch(/One job moves both/);
  });
});

describe('Measured path of two jobs', () => {
  it('is the progress of both, rests included, since both were observed', () => {
    const book = new ProgressBook();
    // A runs for 4 s. B waits until 2 s and runs. From 3 to 5 s B pauses at a progress of 1 s, then
    // it continues.
    for (let i = 0; i <= 240; i++) {
      const t_s = i / 30;
      const b = t_s < 2 ? 0 : t_s < 3 ? t_s - 2 : t_s < 5 ? 1 : t_s - 4;
      book.take(t_s, [...(t_s <= 4 ? [{ job: 'a', progress_s: t_s }] : []), ...(t_s >= 2 ? [{ job: 'b', progress_s: b }] : [])]);
    }
    const way = measured_path(book.of('a'), book.of('b'));
    expect(way[0]).toEqual({ a_s: 0, b_s: 0 });
    const near = (a_s: number, b_s: number) => way.some((point) => Math.hypot(point.a_s - a_s, point.b_s - b_s) < 0.11);
    for (const [a_s, b_s] of [[1, 0], [2, 0], [3, 1], [4, 1], [4, 2.5], [4, 4]] as const) expect(near(a_s, b_s), `${a_s} ${b_s}`).toBe(true);
    // The measured path never cuts the corner: B moves only after A has reached 2 s.
    expect(way.every(({ a_s, b_s }) => b_s < 0.05 || a_s > 1.9)).toBe(true);
    expect(way.every((point, i) => i === 0 || (point.a_s >= (way[i - 1]?.a_s ?? 0) && point.b_s >= (way[i - 1]?.b_s ?? 0)))).toBe(true);
    expect(measured_path(book.of('a'), book.of('c'))).toEqual([]);
    // For a past time, the path has no later points.
    expect(measured_path(book.of('a'), book.of('b'), 2.5).every(({ a_s, b_s }) => a_s <= 2.5 && b_s <= 2.5)).toBe(true);
  });

  it('omits what one job did before it was observed', () => {
    const book = new ProgressBook();
    for (let i = 0; i <= 30; i++) book.take(10 + i / 10, [{ job: 'a', progress_s: 5 + i / 10 }]);
    expect(progress_at(book.of('a') ?? { t_s: [], progress_s: [] }, 9)).toBeNull();
  });

  it('is kept for the last jobs, each with a bounded number of points', () => {
    const book = new ProgressBook();
    for (let i = 0; i < 40_000; i++) book.take(i, [{ job: 'long', progress_s: i }]);
    expect(book.of('long')?.t_s.length).toBeLessThanOrEqual(1200);
    expect(book.of('long')?.progress_s.at(-1)).toBe(39_999);
    for (let i = 0; i < 500; i++) book.take(i, [{ job: `j${i}`, progress_s: 0 }]);
    expect([book.of('long'), book.of('j299')]).toEqual([null, null]);
    expect(book.of('j499')).not.toBeNull();
  });
});
