// The topics of an exported MCAP file, shared by writer and reader. Pure.

import type { kSchemas } from './foxglove_schemas';

interface Topic { topic: string; schema: keyof typeof kSchemas }

export const kTopics = {
  joints: { topic: '/joint_states', schema: 'foxglove.JointStates' }, transforms: { topic: '/tf', schema: 'foxglove.FrameTransforms' },
  scene: { topic: '/scene', schema: 'foxglove.SceneUpdate' }, events: { topic: '/events', schema: 'foxglove.Log' },
  jobs: { topic: '/jobs', schema: 'armloom.Job' }, raw: { topic: '/armloom', schema: 'armloom.Event' },
} as const satisfies Record<string, Topic>;

/** File metadata that relates wall time to cell time. */
export const kMetadata = 'armloom';
export const kWallAtZero = 'wall_time_at_zero_s';

const kNanoseconds = 1_000_000_000n;

export function wall_ns(at_s: number): bigint {
  return BigInt(Math.floor(at_s)) * kNanoseconds + BigInt(Math.floor((at_s % 1) * 1e9));
}
