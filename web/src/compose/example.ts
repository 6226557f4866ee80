// An example job for an arm at rest: a small motion from its current position and back.
//
// The motion follows the rest-to-rest quintic s(u) = 10u³ - 15u⁴ + 6u⁵. Over a distance d in time T
// its maximum velocity is 1.875 d/T, its acceleration 5.7735 d/T² (10/√3) and its jerk 60 d/T³. T
// keeps each below half of its limit.

import { kText } from '../strings';
import { range_of, type Arm, type CellJoint } from '../server/messages';

const kSwing_rad = 0.35;
const kShareOfLimit = 0.5;
const kShortest_s = 1.5;

export interface ExamplePoint {
  positions: number[];
  velocities: number[];
  accelerations: number[];
  time_from_start: { sec: number; nanosec: number };
}

export interface ExampleJob {
  name: string;
  trajectory: { joint_names: string[]; points: ExamplePoint[] };
}

/**
 * Returns the duration with which a rest-to-rest quintic over the distance `d` stays within half of
 * the joint's limits.
 */
export function quintic_duration_s(d: number, joint: CellJoint): number {
  const share = kShareOfLimit;
  const by_velocity = (1.875 * d) / (share * joint.velocity_max);
  const by_acceleration = joint.acceleration_max ? Math.sqrt((5.7735 * d) / (share * joint.acceleration_max)) : 0;
  const by_jerk = joint.jerk_max ? Math.cbrt((60 * d) / (share * joint.jerk_max)) : 0;
  return Math.max(by_velocity, by_acceleration, by_jerk);
}

/**
 * Returns a job that moves the first joint and the last but one. Each moves up, or down if its
 * upper limit is near.
 */
export function example_job(arm: Arm, q: readonly number[], joints: readonly CellJoint[]): ExampleJob {
  const start = q.map((angle) => Number(angle.toFixed(6)));
  const there = [...start];
  let duration_s = kShortest_s;
  for (const i of new Set([0, Math.max(0, start.length - 2)])) {
    const joint = joints.find((j) => j.name === arm.joints[i]);
    const from = start[i];
    if (!joint || from === undefined) continue;
    const to = from + swing(from, joint);
    there[i] = Number(to.toFixed(6));
    duration_s = Math.max(duration_s, quintic_duration_s(Math.abs(to - from), joint));
  }
  duration_s = Math.ceil(duration_s * 10) / 10;
  const rest = start.map(() => 0);
  const point = (positions: number[], t_s: number): ExamplePoint => ({
    positions, velocities: rest, accelerations: rest, time_from_start: split(t_s),
  });
  return {
    name: kText.compose.example_name(arm.name),
    trajectory: {
      joint_names: arm.joints,
      points: [point(start, 0), point(there, duration_s), point(start, 2 * duration_s)],
    },
  };
}

function swing(from: number, joint: CellJoint): number {
  const [lower, upper] = range_of(joint);
  const room_up = upper - from;
  const room_down = from - lower;
  const size = Math.min(joint.unit === 'm' ? 0.02 : kSwing_rad, 0.8 * Math.max(room_up, room_down, 0));
  return room_up >= size / 0.8 ? size : -size;
}

function split(t_s: number): { sec: number; nanosec: number } {
  const sec = Math.floor(t_s + 1e-9);
  return { sec, nanosec: Math.max(0, Math.round((t_s - sec) * 1e9)) };
}

/** Formats JSON with each list of numbers on one line. */
export function pretty(value: unknown): string {
  return JSON.stringify(value, null, 2).replace(
    /\[\n\s*(-?[\d.e+-]+(?:,\n\s*-?[\d.e+-]+)*)\n\s*\]/g,
    (_, numbers: string) => `[${numbers.split(/,\s+/).join(', ')}]`,
  );
}
