// Messages as the server writes them, for the tests.

import type { CellController } from '../src/server/messages';

export const kStream = '5f0c7f0e-6f0e-4d55-9b1c-0d3a54c7a001';

export function arm_json(name: string, over: object = {}): Record<string, unknown> {
  return {
    name, robot: name, state: 'idle', job: null, progress: 0,
    joints: [`${name}_panda_joint1`, `${name}_panda_joint2`], q: [0.1, -1.2], home: [0, -1.2],
    deviation_rad: 0.0002, deviation_max_rad: 0.0005, link: 'up', link_detail: null, drives_on: true, stop_cause: null, ...over,
  };
}

export function controller(over: Partial<CellController> = {}): CellController {
  return { type: 'sim', reaction_s: 0.02, feedback_period_s: 0.001, feedback_timeout_s: 0.1, tracking_error_rad: 0.001, ...over };
}

export function job_json(id: string, over: object = {}): Record<string, unknown> {
  return {
    id, name: '', state: 'queued', arms: ['left'], priority: 0,
    submitted_s: 1, scheduled_s: null, started_s: null, ended_s: null,
    submitted_at: '2026-01-01T00:00:00.000Z', scheduled_at: null, started_at: null, ended_at: null,
    progress: 0, duration_s: 4, stopping: false, waits_on: [], cycle: [], result: null, ...over,
  };
}

export function wait_json(over: object = {}): Record<string, unknown> {
  return {
    kind: 'job', id: 'place-6', arm: 'right', links: ['left_panda_hand', 'right_panda_link6'],
    own_time_s: 1.24, other_time_s: 0.8, clearance_m: 0.012, ...over,
  };
}

export function envelope(type: string, seq: number, data: unknown, over: object = {}): string {
  return JSON.stringify({ stream: kStream, seq, type, t_s: seq, at: '2026-01-01T00:00:00Z', data, ...over });
}

export function snapshot(seq: number, over: object = {}, envelope_over: object = {}): string {
  const data = {
    cell: 'two_pandas', policy: 'timed_discrete', speed: 1, stopped: false,
    arms: [arm_json('left'), arm_json('right')], jobs: [],
    queue: { stopped: false, queued: [], backlog: [], scheduled: [], running: [] },
    objects: [{ name: 'table', box: [2, 2, 0.1], xyz: [0, 0, 0.05], rpy: [0, 0, 0] }], ...over,
  };
  return envelope('snapshot', seq, data, envelope_over);
}

export function frame(t_s: number, q: Record<string, number>, over: object = {}): string {
  return JSON.stringify({ type: 'state', t_s, q, clearance: [{ arms: ['left', 'right'], m: 0.2, links: ['a', 'b'] }], motions: [], speed: 1, ...over });
}

type Ranges = [state: string, a0: number, a1: number, b0: number, b1: number];

/** Returns a diagram of the jobs `left` (4 s) and `right` (3 s) with these cells. */
export function diagram_json(cells: Ranges[], over: object = {}): Record<string, unknown> {
  return {
    t_s: 7, a: { id: 'left', state: 'running', duration_s: 4, progress_s: 1 },
    b: { id: 'right', state: 'backlogged', duration_s: 3, progress_s: 0 },
    layers: [{ arms: ['left', 'right'], first_contact: null, cells: cells.map(([state, a0, a1, b0, b1]) => ({ state, a_s: [a0, a1], b_s: [b0, b1] })) }],
    evaluations: 12, scene_version: 1, ...over,
  };
}

export function step_json(kind: string, over: object = {}): Record<string, unknown> {
  return { name: '', kind, state: 'waiting', detail: '', arms: [], progress: 0, ...over };
}

export function object_json(name: string, over: object = {}): Record<string, unknown> {
  return { name, box: [0.1, 0.1, 0.1], xyz: [0, 0, 0], rpy: [0, 0, 0], ...over };
}

/** Returns an object that the hand of an arm holds. `over` changes the object. */
export function held_json(name: string, arm: string, over: object = {}): Record<string, unknown> {
  return { object: object_json(name, over), link: `${arm}_hand`, arm };
}

/** Returns a scene with these objects. `held` has the arm of each held object. */
export function scene_json(objects: readonly string[], held: Readonly<Record<string, string>>): { version: number; objects: unknown[]; held: unknown[] } {
  return { version: 2, objects: objects.map((name) => object_json(name)), held: Object.entries(held).map(([name, arm]) => held_json(name, arm)) };
}
