// Everything the server can say, as types, and the only place where its JSON is checked.
//
// Messages on the WebSocket form one union discriminated by `type`. `parse_message` never throws:
// it answers the message, or that the type is unknown (a newer server), or what is malformed and
// where. Times are seconds of cell time, angles rad, lengths m, as in the server's contract.

import { at, attempt, fault_of, type Field, type Parsed } from './field';

export type ArmState = 'idle' | 'moving' | 'holding' | 'stopped' | 'fault';
export type JobState =
  | 'queued' | 'backlogged' | 'scheduled' | 'running' | 'holding'
  | 'succeeded' | 'canceled' | 'expired' | 'failed' | 'interrupted';
export type WaitKind = 'job' | 'arm' | 'object' | 'order' | 'capacity' | 'stop';

const kArmStates: readonly ArmState[] = ['idle', 'moving', 'holding', 'stopped', 'fault'];
const kJobStates: readonly JobState[] = [
  'queued', 'backlogged', 'scheduled', 'running', 'holding',
  'succeeded', 'canceled', 'expired', 'failed', 'interrupted',
];
export type CellState = 'free' | 'conflict' | 'undecided';

const kCellStates: readonly CellState[] = ['free', 'conflict', 'undecided'];
const kWaitKinds: readonly WaitKind[] = ['job', 'arm', 'object', 'order', 'capacity', 'stop'];

export interface Arm {
  name: string;
  robot: string;
  state: ArmState;
  job: string | null;
  progress: number;
  joints: string[];
  q: number[];
  home: number[];
  deviation_rad: number | null;
}

/** One thing that a job waits on; times count from the start of each one's own trajectory. */
export interface WaitsOn {
  kind: WaitKind;
  id: string | null;
  arm: string | null;
  links: [string, string] | null;
  own_time_s: number | null;
  other_time_s: number | null;
  clearance_m: number | null;
  /** For a stop: its cause. */
  detail: string | null;
}

export interface JobResult {
  reason: string;
  detail: string | null;
}

export interface Job {
  id: string;
  name: string | null;
  state: JobState;
  arms: string[];
  priority: number;
  submitted_s: number | null;
  started_s: number | null;
  ended_s: number | null;
  progress: number;
  duration_s: number | null;
  stopping: boolean;
  waits_on: WaitsOn[];
  /** Ids of the deadlock that it is part of, itself first; else empty. */
  ring: string[];
  result: JobResult | null;
  /** The job as the server wrote it, for the detail view. */
  raw: unknown;
}

export type Shape =
  | { kind: 'box'; size: [number, number, number] }
  | { kind: 'cylinder'; radius: number; length: number }
  | { kind: 'sphere'; radius: number }
  /** Served at `address` by the same server; in metres once scaled. */
  | { kind: 'mesh'; address: string; scale: [number, number, number] };

export interface SceneObject {
  name: string;
  /** null for a shape that this page does not know. */
  shape: Shape | null;
  xyz: [number, number, number];
  rpy: [number, number, number];
}

export interface CellArm {
  name: string;
  joints: string[];
  gripper_joints: string[];
  home: number[];
}

export interface CellRobot {
  name: string;
  prefix: string;
  base: { xyz: [number, number, number]; rpy: [number, number, number] };
  urdf: string;
  /** Where the meshes are served that the URDF names, by the name there ("package://..."). */
  meshes: Record<string, string>;
  arms: CellArm[];
}

export interface CellJoint {
  name: string;
  arm: string | null;
  lower: number;
  upper: number;
  velocity_max: number;
  acceleration_max: number | null;
  jerk_max: number | null;
  unit: string;
}

export interface Cell {
  name: string;
  policy: string;
  speed: number;
  robots: CellRobot[];
  objects: SceneObject[];
  joints: CellJoint[];
  clearance_m: number | null;
}

/** The smallest distance of a pair: two arms, or one arm and an object of the scene. */
export interface Clearance {
  arms: string[];
  m: number;
  links: [string, string] | null;
}

/** A rectangle of trajectory times of A and of B, each [from, to]. */
export interface DiagramCell { state: CellState; a_s: [number, number]; b_s: [number, number] }

export interface DiagramSide { id: string; duration_s: number; progress_s: number }

/** What one arm of A and one arm of B do to each other, wherever each is on its way. */
export interface DiagramLayer { arms: [string, string]; cells: DiagramCell[] }

/** The coordination diagram of two jobs. */
export interface Diagram {
  a: DiagramSide;
  b: DiagramSide;
  layers: DiagramLayer[];
  evaluations: number;
  scene_version: number;
}

/** RFC 9457, with the place of the fault and the value found. */
export interface Problem {
  title: string;
  status: number;
  detail: string | null;
  pointer: string | null;
  value: unknown;
  errors: { pointer: string | null; detail: string | null; value: unknown }[];
}

interface Sequenced { stream: string; seq: number; t_s: number }

export interface SnapshotData {
  cell: string;
  policy: string;
  speed: number;
  stopped: boolean;
  arms: Arm[];
  jobs: Job[];
  /** The order in the lists; null when the server leaves it to the next queue event. */
  queue: QueueData | null;
  objects: SceneObject[];
  gap: boolean;
}
export interface QueueData {
  stopped: boolean;
  queued: string[];
  backlog: string[];
  scheduled: string[];
  running: string[];
}
export interface MonitorData {
  kind: string;
  arms: string[];
  links: [string, string] | null;
  clearance_m: number | null;
  limit_m: number | null;
  stopped: string[];
}
export interface AlertData { level: 'info' | 'warning' | 'error'; text: string }

export interface SnapshotMessage extends Sequenced { type: 'snapshot'; data: SnapshotData }
export interface JobMessage extends Sequenced { type: 'job'; data: Job }
export interface ArmMessage extends Sequenced { type: 'arm'; data: Arm }
export interface QueueMessage extends Sequenced { type: 'queue'; data: QueueData }
export interface MonitorMessage extends Sequenced { type: 'monitor'; data: MonitorData }
export interface AlertMessage extends Sequenced { type: 'alert'; data: AlertData }
export interface SceneMessage extends Sequenced { type: 'scene'; data: { objects: SceneObject[] } }
/** A frame of poses: carries no sequence number and may be dropped on the way. */
export interface StateMessage {
  type: 'state';
  t_s: number;
  q: Record<string, number>;
  clearance: Clearance[];
}

export type SequencedMessage =
  | SnapshotMessage | JobMessage | ArmMessage | QueueMessage
  | MonitorMessage | AlertMessage | SceneMessage;
export type Message = SequencedMessage | StateMessage;

export type { Parsed };
export type ParsedMessage =
  | { kind: 'message'; message: Message }
  | { kind: 'unknown'; type: string; stream: string | null; seq: number | null }
  | { kind: 'malformed'; fault: string };

export function parse_message(text: string): ParsedMessage {
  try {
    const root = at(JSON.parse(text), '');
    const type = root.get('type').text();
    const message = read_message(type, root);
    if (message) return { kind: 'message', message };
    return {
      kind: 'unknown', type,
      stream: root.get('stream').or_null((f) => f.text()),
      seq: root.get('seq').or_null((f) => f.number()),
    };
  } catch (error) {
    return { kind: 'malformed', fault: fault_of(error) };
  }
}

export function parse_cell(value: unknown): Parsed<Cell> {
  return attempt(() => read_cell(at(value, '')));
}

export function parse_job(value: unknown): Parsed<Job> {
  return attempt(() => read_job(at(value, '')));
}

export function parse_diagram(value: unknown): Parsed<Diagram> {
  return attempt(() => read_diagram(at(value, '')));
}

export function parse_problem(value: unknown): Parsed<Problem> {
  return attempt(() => read_problem(at(value, '')));
}

// ---- the shapes, one reader each ----

function read_message(type: string, root: Field): Message | null {
  if (type === 'state') {
    return {
      type,
      t_s: root.get('t_s').number(),
      q: root.get('q').numbers_by_name(),
      clearance: root.get('clearance').list_or_empty(read_clearance),
    };
  }
  const envelope = () => ({
    stream: root.get('stream').text(),
    seq: root.get('seq').number(),
    t_s: root.get('t_s').number(),
  });
  const data = root.get('data');
  switch (type) {
    case 'snapshot': return { type, ...envelope(), data: read_snapshot(data) };
    case 'job': return { type, ...envelope(), data: read_job(data) };
    case 'arm': return { type, ...envelope(), data: read_arm(data) };
    case 'queue': return { type, ...envelope(), data: read_queue(data) };
    case 'monitor': return { type, ...envelope(), data: read_monitor(data) };
    case 'alert': return { type, ...envelope(), data: read_alert(data) };
    case 'scene': return { type, ...envelope(), data: { objects: data.get('objects').list(read_object) } };
    default: return null;
  }
}

function read_snapshot(f: Field): SnapshotData {
  return {
    cell: f.get('cell').text(),
    policy: f.get('policy').text(),
    speed: f.get('speed').number(),
    stopped: f.get('stopped').flag(),
    arms: f.get('arms').list(read_arm),
    jobs: f.get('jobs').list(read_job),
    queue: f.get('queue').or_null(read_queue),
    objects: f.get('objects').list_or_empty(read_object),
    gap: f.get('gap').or_null((g) => g.flag()) ?? false,
  };
}

function read_queue(f: Field): QueueData {
  const ids = (key: string) => f.get(key).list_or_empty((e) => e.text());
  return {
    stopped: f.get('stopped').flag(),
    queued: ids('queued'), backlog: ids('backlog'), scheduled: ids('scheduled'), running: ids('running'),
  };
}

function read_monitor(f: Field): MonitorData {
  return {
    kind: f.get('kind').text(),
    arms: f.get('arms').list_or_empty((e) => e.text()),
    links: f.get('links').text_pair_or_null(),
    clearance_m: f.get('clearance_m').or_null((e) => e.number()),
    limit_m: f.get('limit_m').or_null((e) => e.number()),
    stopped: f.get('stopped').list_or_empty((e) => e.text()),
  };
}

function read_alert(f: Field): AlertData {
  return { level: f.get('level').one_of(['info', 'warning', 'error']), text: f.get('text').text() };
}

function read_clearance(f: Field): Clearance {
  return {
    arms: f.get('arms').list((e) => e.text()),
    m: f.get('m').number(),
    links: f.get('links').text_pair_or_null(),
  };
}

function read_arm(f: Field): Arm {
  return {
    name: f.get('name').text(),
    robot: f.get('robot').text(),
    state: f.get('state').one_of(kArmStates),
    job: f.get('job').or_null((e) => e.text()),
    progress: f.get('progress').or_null((e) => e.number()) ?? 0,
    joints: f.get('joints').list((e) => e.text()),
    q: f.get('q').list((e) => e.number()),
    home: f.get('home').list_or_empty((e) => e.number()),
    deviation_rad: f.get('deviation_rad').or_null((e) => e.number()),
  };
}

function read_job(f: Field): Job {
  const seconds = (key: string) => f.get(key).or_null((e) => e.number());
  return {
    id: f.get('id').text(),
    name: f.get('name').text_or_null(),
    state: f.get('state').one_of(kJobStates),
    arms: f.get('arms').list((e) => e.text()),
    priority: f.get('priority').or_null((e) => e.number()) ?? 0,
    submitted_s: seconds('submitted_s'),
    started_s: seconds('started_s'),
    ended_s: seconds('ended_s'),
    progress: f.get('progress').or_null((e) => e.number()) ?? 0,
    duration_s: seconds('duration_s'),
    stopping: f.get('stopping').or_null((e) => e.flag()) ?? false,
    waits_on: f.get('waits_on').list_or_empty(read_waits_on),
    ring: f.get('ring').list_or_empty((e) => e.text()),
    result: f.get('result').or_null((e) => ({
      reason: e.get('reason').text(),
      detail: e.get('detail').text_or_null(),
    })),
    raw: f.value,
  };
}

function read_waits_on(f: Field): WaitsOn {
  return {
    kind: f.get('kind').one_of(kWaitKinds),
    id: f.get('id').or_null((e) => e.text()),
    arm: f.get('arm').or_null((e) => e.text()),
    links: f.get('links').text_pair_or_null(),
    own_time_s: f.get('own_time_s').or_null((e) => e.number()),
    other_time_s: f.get('other_time_s').or_null((e) => e.number()),
    clearance_m: f.get('clearance_m').or_null((e) => e.number()),
    detail: f.get('detail').text_or_null(),
  };
}

function read_object(f: Field): SceneObject {
  return {
    name: f.get('name').text(),
    shape: read_shape(f),
    xyz: f.get('xyz').or_null((e) => e.triple()) ?? [0, 0, 0],
    rpy: f.get('rpy').or_null((e) => e.triple()) ?? [0, 0, 0],
  };
}

function read_shape(f: Field): Shape | null {
  const box = f.get('box').or_null((e) => e.triple());
  if (box) return { kind: 'box', size: box };
  const cylinder = f.get('cylinder').or_null((e) => e.list((n) => n.number()));
  if (cylinder) {
    const [radius, length] = cylinder;
    if (radius === undefined || length === undefined) return f.get('cylinder').fail('[radius, length]');
    return { kind: 'cylinder', radius, length };
  }
  const sphere = f.get('sphere').or_null((e) => e.list((n) => n.number()));
  if (sphere?.[0] !== undefined) return { kind: 'sphere', radius: sphere[0] };
  const mesh = f.get('mesh').or_null((e) => e.text());
  if (mesh) return { kind: 'mesh', address: mesh, scale: f.get('scale').or_null((e) => e.triple()) ?? [1, 1, 1] };
  return null;
}

function read_cell(f: Field): Cell {
  return {
    name: f.get('name').text(),
    policy: f.get('policy').text(),
    speed: f.get('speed').or_null((e) => e.number()) ?? 1,
    robots: f.get('robots').list(read_robot),
    objects: f.get('objects').list_or_empty(read_object),
    joints: f.get('joints').list(read_joint),
    clearance_m: f.get('clearance_m').or_null((e) => e.number()),
  };
}

function read_robot(f: Field): CellRobot {
  const base = f.get('base');
  return {
    name: f.get('name').text(),
    prefix: f.get('prefix').or_null((e) => e.text()) ?? '',
    base: { xyz: base.get('xyz').triple(), rpy: base.get('rpy').triple() },
    urdf: f.get('urdf').text(),
    meshes: f.get('meshes').or_null((e) => e.texts_by_name()) ?? {},
    arms: f.get('arms').list((arm) => ({
      name: arm.get('name').text(),
      joints: arm.get('joints').list((e) => e.text()),
      gripper_joints: arm.get('gripper_joints').list_or_empty((e) => e.text()),
      home: arm.get('home').list_or_empty((e) => e.number()),
    })),
  };
}

function read_joint(f: Field): CellJoint {
  return {
    name: f.get('name').text(),
    arm: f.get('arm').or_null((e) => e.text()),
    // JSON has no infinity: null stands for a limit that a joint does not have.
    lower: f.get('lower').or_null((e) => e.number()) ?? -Infinity,
    upper: f.get('upper').or_null((e) => e.number()) ?? Infinity,
    velocity_max: f.get('velocity_max').or_null((e) => e.number()) ?? Infinity,
    acceleration_max: f.get('acceleration_max').or_null((e) => e.number()),
    jerk_max: f.get('jerk_max').or_null((e) => e.number()),
    unit: f.get('unit').or_null((e) => e.text()) ?? 'rad',
  };
}

function read_diagram(f: Field): Diagram {
  const side = (e: Field): DiagramSide => ({
    id: e.get('id').text(), duration_s: e.get('duration_s').number(), progress_s: e.get('progress_s').number(),
  });
  return {
    a: side(f.get('a')),
    b: side(f.get('b')),
    layers: f.get('layers').list((layer) => ({
      arms: layer.get('arms').text_pair_or_null() ?? layer.get('arms').fail('two strings'),
      cells: layer.get('cells').list((cell) => ({
        state: cell.get('state').one_of(kCellStates), a_s: cell.get('a_s').pair(), b_s: cell.get('b_s').pair(),
      })),
    })),
    evaluations: f.get('evaluations').number(),
    scene_version: f.get('scene_version').number(),
  };
}

function read_problem(f: Field): Problem {
  const place = (e: Field) => ({
    pointer: e.get('pointer').or_null((p) => p.text()),
    detail: e.get('detail').or_null((d) => d.text()),
    value: e.get('value').value,
  });
  return {
    title: f.get('title').text(),
    status: f.get('status').number(),
    ...place(f),
    errors: f.get('errors').list_or_empty(place),
  };
}
