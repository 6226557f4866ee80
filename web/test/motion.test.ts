import { describe, expect, it } from 'vitest';
import { bodies_of, read_bag } from '../src/compose/bag';
import { motion_of } from '../src/compose/motion';

const body = (id: string, joints: string[], stations: number[][], velocities = true) => ({
  id, trajectory: {
    joint_names: joints,
    points: stations.map((positions, i) => ({
      positions, time_from_start: { sec: 2 * i, nanosec: 0 }, ...(velocities ? { velocities: positions.map(() => 0) } : {}),
    })),
  },
});
const motion = (value: unknown) => motion_of(read_bag(JSON.stringify(value)));

describe('what was pasted', () => {
  it('is one job, or a bag in any of its shapes', () => {
    const a = body('a', ['x'], [[0], [1]]);
    expect(read_bag(JSON.stringify(a)).kind).toBe('one');
    expect(read_bag('{ not json').kind).toBe('one');
    expect(read_bag('[]').kind).toBe('one');
    for (const bag of [[a, a], { jobs: [a, a] }, [{ at: 0, job: a }, { at: 1, job: a }]]) {
      expect(read_bag(JSON.stringify(bag))).toEqual({ kind: 'bag', jobs: [a, a] });
    }
    expect(bodies_of(read_bag(JSON.stringify([a, { trajectory: {} }]))).map(({ title }) => title)).toEqual(['a', 'job 2']);
  });

  it('moves as it says: rest to rest halfway at half time, and at its ends beyond', () => {
    const shown = motion(body('a', ['x', 'y'], [[0, 1], [2, 1]]));
    expect(shown?.duration_s).toBe(2);
    expect(shown?.q_at(1)).toEqual({ x: 1, y: 1 });
    expect(shown?.q_at(0.5)['x']).toBeCloseTo(2 * (3 * 0.0625 - 2 * 0.015625));
    expect(shown?.q_at(99)).toEqual({ x: 2, y: 1 });
    expect(motion(body('a', ['x'], [[0], [2]], false))?.q_at(0.5)['x']).toBeCloseTo(0.5);
  });

  it('moves one after the other on one arm, and together on two', () => {
    const shown = motion([body('a', ['x'], [[0], [1]]), body('b', ['x'], [[1], [5]]), body('c', ['z'], [[3], [4]])]);
    expect(shown?.duration_s).toBe(4);
    expect(shown?.q_at(1)).toEqual({ x: 0.5, z: 3.5 });
    expect(shown?.q_at(3)).toEqual({ x: 3, z: 4 });
  });

  it('takes the times of ROS 1, plain seconds, and MoveIt\'s nesting; shows nothing of what makes no sense', () => {
    const points = [{ positions: [0], time_from_start: 0 }, { positions: [1], time_from_start: { secs: 1, nsecs: 5e8 } }];
    expect(motion({ trajectory: { joint_trajectory: { joint_names: ['x'], points } } })?.duration_s).toBe(1.5);
    for (const wrong of [null, 7, {}, { trajectory: { joint_names: ['x'], points: [] } }, { trajectory: { joint_names: ['x', 'y'], points } }]) {
      expect(motion(wrong)).toBeNull();
    }
  });
});
