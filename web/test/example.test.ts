import { describe, expect, it } from 'vitest';
import { example_job, pretty, quintic_duration_s } from '../src/compose/example';
import { parse_message, type CellJoint } from '../src/server/messages';
import { arm_json, envelope } from './samples';

function arm() {
  const parsed = parse_message(envelope('arm', 1, arm_json('left')));
  if (parsed.kind !== 'message' || parsed.message.type !== 'arm') throw new Error('no arm');
  return parsed.message.data;
}

function joint(name: string, over: Partial<CellJoint> = {}): CellJoint {
  return { name, arm: 'left', lower: -2.9, upper: 2.9, velocity_max: 2, acceleration_max: 4, jerk_max: 7500, brake: 8, unit: 'rad', ...over };
}

const joints = [joint('left_panda_joint1'), joint('left_panda_joint2', { lower: -1.3 })];

/**
 * Samples the quintic over the distance d in time T. Returns its largest velocity and acceleration.
 */
function peaks(d: number, T: number): { velocity: number; acceleration: number } {
  let velocity = 0;
  let acceleration = 0;
  for (let i = 0; i <= 1000; i++) {
    const u = i / 1000;
    velocity = Math.max(velocity, Math.abs((d / T) * (30 * u ** 2 - 60 * u ** 3 + 30 * u ** 4)));
    acceleration = Math.max(acceleration, Math.abs((d / T ** 2) * (60 * u - 180 * u ** 2 + 120 * u ** 3)));
  }
  return { velocity, acceleration };
}

describe('Example job', () => {
  it('starts and ends at the arm\'s position, at rest', () => {
    const { trajectory } = example_job(arm(), [0.1, -1.2], joints);
    const [first, there, last] = trajectory.points;
    expect(first?.positions).toEqual([0.1, -1.2]);
    expect(last?.positions).toEqual([0.1, -1.2]);
    expect(there?.positions[0]).not.toBe(0.1);
    for (const point of trajectory.points) {
      expect(point.velocities).toEqual([0, 0]);
      expect(point.accelerations).toEqual([0, 0]);
    }
    expect(trajectory.joint_names).toEqual(['left_panda_joint1', 'left_panda_joint2']);
  });

  it('stays below half of each limit', () => {
    for (const limits of [joint('j'), joint('j', { velocity_max: 0.1 }), joint('j', { acceleration_max: 0.2 })]) {
      const T = quintic_duration_s(0.35, limits);
      expect(peaks(0.35, T).velocity).toBeLessThanOrEqual(0.5 * limits.velocity_max * 1.0001);
      expect(peaks(0.35, T).acceleration).toBeLessThanOrEqual(0.5 * limits.acceleration_max! * 1.0001);
    }
  });

  it('stays within position limits, moving away from the near limit', () => {
    const near_upper = example_job(arm(), [2.85, -1.2], joints).trajectory.points[1]!.positions[0]!;
    expect(near_upper).toBeLessThan(2.85);
    const narrow = [joint('left_panda_joint1', { lower: 0, upper: 0.2 }), joints[1]!];
    const to = example_job(arm(), [0.1, -1.2], narrow).trajectory.points[1]!.positions[0]!;
    expect(to).toBeGreaterThanOrEqual(0);
    expect(to).toBeLessThanOrEqual(0.2);
  });

  it('has increasing times with whole nanoseconds', () => {
    const times = example_job(arm(), [0.1, -1.2], joints).trajectory.points.map((p) => p.time_from_start);
    for (const t of times) {
      expect(Number.isInteger(t.sec) && Number.isInteger(t.nanosec) && t.nanosec < 1e9).toBe(true);
    }
    const [, there, back] = times.map((t) => t.sec + t.nanosec * 1e-9);
    expect(back).toBeCloseTo(2 * there!);
  });

  it('is formatted with one line per list, as equal JSON', () => {
    const job = example_job(arm(), [0.1, -1.2], joints);
    expect(pretty(job)).toContain('"positions": [0.1, -1.2]');
    expect(JSON.parse(pretty(job))).toEqual(job);
  });
});
