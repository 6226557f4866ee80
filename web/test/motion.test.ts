import { describe, expect, it } from 'vitest';
import { bodies_of, read_batch } from '../src/compose/batch';
import { motion_of } from '../src/motion/pasted';
import { motion_of_piece, read_trajectory } from '../src/motion/motion';
import { MotionBook } from '../src/motion/motion_book';
import { parse_job_motion, type JobMotion } from '../src/server/messages';

const body = (id: string, joints: string[], stations: number[][], velocities = true) => ({
  id, trajectory: {
    joint_names: joints,
    points: stations.map((positions, i) => ({
      positions, time_from_start: { sec: 2 * i, nanosec: 0 }, ...(velocities ? { velocities: positions.map(() => 0) } : {}),
    })),
  },
});
const motion = (value: unknown) => motion_of(read_batch(JSON.stringify(value)));

describe('Pasted text', () => {
  it('is one job, or a batch in any of its formats', () => {
    const a = body('a', ['x'], [[0], [1]]);
    expect(read_batch(JSON.stringify(a)).kind).toBe('one');
    expect(read_batch('{ not json').kind).toBe('one');
    expect(read_batch('[]').kind).toBe('one');
    for (const batch of [[a, a], { jobs: [a, a] }, [{ at: 0, job: a }, { at: 1, job: a }]]) {
      expect(read_batch(JSON.stringify(batch))).toEqual({ kind: 'batch', jobs: [a, a] });
    }
    expect(bodies_of(read_batch(JSON.stringify([a, { trajectory: {} }]))).map(({ title }) => title)).toEqual(['a', 'job 2']);
  });

  it('moves from rest to rest, halfway at half time, and stays at its ends', () => {
    const shown = motion(body('a', ['x', 'y'], [[0, 1], [2, 1]]));
    expect(shown?.duration_s).toBe(2);
    expect(shown?.q_at(1)).toEqual({ x: 1, y: 1 });
    expect(shown?.q_at(0.5)['x']).toBeCloseTo(2 * (3 * 0.0625 - 2 * 0.015625));
    expect(shown?.q_at(99)).toEqual({ x: 2, y: 1 });
    expect(motion(body('a', ['x'], [[0], [2]], false))?.q_at(0.5)['x']).toBeCloseTo(0.5);
  });

  it('moves one arm through its jobs one after the other, and two arms together', () => {
    const shown = motion([body('a', ['x'], [[0], [1]]), body('b', ['x'], [[1], [5]]), body('c', ['z'], [[3], [4]])]);
    expect(shown?.duration_s).toBe(4);
    expect(shown?.q_at(1)).toEqual({ x: 0.5, z: 3.5 });
    expect(shown?.q_at(3)).toEqual({ x: 3, z: 4 });
  });

  it('accepts times of ROS 1, plain seconds and MoveIt\'s nesting; ignores invalid input', () => {
    const points = [{ positions: [0], time_from_start: 0 }, { positions: [1], time_from_start: { secs: 1, nsecs: 5e8 } }];
    expect(motion({ trajectory: { joint_trajectory: { joint_names: ['x'], points } } })?.duration_s).toBe(1.5);
    for (const wrong of [null, 7, {}, { trajectory: { joint_names: ['x'], points: [] } }, { trajectory: { joint_names: ['x', 'y'], points } }]) {
      expect(motion(wrong)).toBeNull();
    }
  });
});

describe('Trajectory', () => {
  const piece = (accelerations: boolean) => read_trajectory({
    joint_names: ['a'],
    points: [0, 2].map((t_s, i) => ({ time_from_start: t_s, positions: [i], velocities: [0], ...(accelerations ? { accelerations: [0] } : {}) })),
  });

  it('is quintic with accelerations, cubic without', () => {
    const at = (accelerations: boolean, t_s: number) => {
      const read = piece(accelerations);
      return read ? motion_of_piece(read).q_at(t_s)['a'] : NaN;
    };
    const u = 0.25;
    expect(at(true, 2 * u)).toBeCloseTo(10 * u ** 3 - 15 * u ** 4 + 6 * u ** 5, 12);
    expect(at(false, 2 * u)).toBeCloseTo(3 * u ** 2 - 2 * u ** 3, 12);
    expect(at(true, -1)).toBe(0);
    expect(at(true, 9)).toBe(1);
  });

  it('is fetched once, again after a replan, and a few at a time', async () => {
    const asked: string[] = [];
    const answers: (() => void)[] = [];
    const book = new MotionBook((id) => new Promise((done) => {
      asked.push(id);
      answers.push(() => done({ ok: true, value: { id, duration_s: 2, trajectory: { joint_names: ['a'], points: [{ positions: [0], time_from_start: 0 }, { positions: [1], time_from_start: 2 }] } } as JobMotion }));
    }));
    const job = (id: string, duration_s = 2) => ({ id, duration_s, arms: ['left'] });
    for (let i = 0; i < 6; i++) expect(book.of(job(`j${i}`))).toBeNull();
    expect(book.of(job('j0'))).toBeNull();
    expect(asked).toEqual(['j0', 'j1', 'j2', 'j3']);
    const before = book.changes.value;
    for (const answer of answers.splice(0)) answer();
    await new Promise((done) => setTimeout(done));
    expect(asked).toHaveLength(6);
    expect(book.changes.value).toBe(before + 4);
    expect(book.of(job('j0'))?.q_at(1)).toEqual({ a: 0.5 });
    expect(book.of(job('j0', 3))?.duration_s).toBe(2);  // the old motion is returned until the new motion arrives
    for (const answer of answers.splice(0)) answer();
    await new Promise((done) => setTimeout(done));
    expect(asked.at(-1)).toBe('j0');
  });
});

describe('Longest trajectory that the server accepts', () => {
  // Checking and reading may take this many times as long as parsing the JSON. Users notice a task
  // above 0.1 s.
  const kMostTimesJson = 6;

  it('is read in about the time that parsing its JSON takes', () => {
    const rest = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7];
    const points = Array.from({ length: 10_000 }, (_, i) => ({ positions: rest, velocities: rest, accelerations: rest, time_from_start: { sec: i, nanosec: 0 } }));
    const text = JSON.stringify({ id: 'long', duration_s: 9999, trajectory: { joint_names: ['a', 'b', 'c', 'd', 'e', 'f', 'g'], points } });
    const ratios = [1, 2, 3].map(() => {
      const from_ms = performance.now();
      const value: unknown = JSON.parse(text);
      const parsed_ms = performance.now();
      const checked = parse_job_motion(value);
      expect(checked.ok && read_trajectory(checked.value.trajectory)?.points.length).toBe(10_000);
      return (performance.now() - parsed_ms) / (parsed_ms - from_ms);
    });
    expect(Math.min(...ratios)).toBeLessThan(kMostTimesJson);
  });
});
