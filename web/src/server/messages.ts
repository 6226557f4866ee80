// The types of the server's messages, and the only place that parses them. Types and schemas are
// generated from the server's OpenAPI description (src/contract, `npm run contract`).
//
// WebSocket messages are a union discriminated by `type`. `parse_message` never throws. It returns
// the message, the unknown type (of a newer server), or the fault of a malformed message. Times are
// cell time in seconds, angles are in rad, lengths in m.

import { check, type Parsed, type Schemas } from './check';
import shapes from '../contract/schemas.json';

export type { Parsed };
export type ArmState = Schemas['ArmState'];
export type JobState = Schemas['JobState'];
export type Arm = Schemas['Arm'];
/** A reason to wait. Each of its times counts from the start of that job's own trajectory. */
export type WaitsOn = Schemas['Wait'];
export type Job = Schemas['Job'];
/** A step of a job. */
export type Step = Schemas['Step'];
export type SceneObject = Schemas['Object'];
/** An object that an arm holds. Its pose is in the frame of `link`. */
export type HeldObject = Schemas['HeldObject'];
/** The objects of the scene, and those that arms hold. */
export type Scene = Schemas['Scene'];
/** An input or output of the cell. */
export type Signal = Schemas['Signal'];
export type SignalValue = NonNullable<Signal['value']>;
export type Cell = Schemas['Cell'];
export type CellArm = Schemas['CellArm'];
export type CellRobot = Schemas['CellRobot'];
/** The kind of a robot's controller, and what it promises. */
export type CellController = Schemas['CellController'];
export type CellJoint = Schemas['CellJoint'];
/** The coordination diagram of two jobs. */
export type Diagram = Schemas['Diagram'];
/** The conflicts between one arm of A and one arm of B. */
export type DiagramLayer = Diagram['layers'][number];
/** The first point of the prediction that is not free. */
export type DiagramContact = Schemas['DiagramContact'];
export type CellState = Schemas['DiagramCell']['state'];
/** The predicted motions of each arm. */
export type Forecast = Schemas['Timeline'];
export type ForecastStep = Schemas['TimelineStep'];
/** The result of a check. */
export type Verdict = Schemas['Verdict'];
/** The members of a job that can be changed. */
export type JobAmendment = Partial<Pick<Job, 'name' | 'priority' | 'backlog_timeout_s' | 'on_timeout'>>;
/** The trajectory of a job. */
export type JobMotion = Schemas['JobMotion'];
/** A planned path to a goal. No arm executes it. */
export type Plan = Schemas['Plan'];
/** An alert that the server keeps, with its acknowledgement if there is one. */
export type KeptAlert = Schemas['KeptAlert'];
export type AlertList = Schemas['AlertList'];
/** The user and role of this browser. */
export type Session = Schemas['Session'];
/** The same jobs simulated under several policies. */
export type Comparison = Schemas['Comparison'];
export type PolicyRun = Schemas['PolicyRun'];
/** The holder of control for jogging. */
export type Control = Schemas['Control'];
export type ControlTaken = Schemas['ControlTaken'];
export type ControlHolder = Schemas['ControlHolder'];
/** A jog motion. */
export type Jog = Schemas['Jog'];
/** A page of the job list, newest first. */
export type JobPage = Schemas['JobPage'];
/** The measured joint positions of the last minutes. */
export type MeasuredStates = Schemas['MeasuredStates'];
/** The recordings on the server. */
export type RecordingList = Schemas['RecordingList'];
export type KeptRecording = Schemas['Recording'];
/** A fault of a simulated arm, or of the link to its controller. */
export type Fault = Schemas['Fault'];
export type FaultRequest = Schemas['FaultRequest'];
export type FaultKind = FaultRequest['kind'];
export type QueueData = Schemas['QueueIds'];
export type MonitorData = Schemas['MonitorFinding'];
/** An error in the format of RFC 9457, with a JSON pointer to the fault and the value found. */
export type Problem = Schemas['Problem'];
export type Message = Schemas['Message'];
/** A frame of joint positions. It has no sequence number, and the server may drop it. */
export type StateMessage = Schemas['StateFrame'];
export type SequencedMessage = Exclude<Message, StateMessage>;
/** The clearance of a pair: two arms, or an arm and an object. */
export type Clearance = StateMessage['clearance'][number];
/** The progress and authority of an arm in its motion, in seconds of the trajectory. */
export type ArmAuthority = Schemas['ArmAuthority'];

export type Shape =
  | { kind: 'box'; size: [number, number, number] }
  | { kind: 'cylinder'; radius: number; length: number }
  | { kind: 'sphere'; radius: number }
  /**
   * A mesh file, which the same server serves at `address`. `scale` converts its lengths to meters.
   */
  | { kind: 'mesh'; address: string; scale: [number, number, number] };

/** Returns the names of two links, or null if the list is empty. */
export function pair_of(links: readonly string[]): [string, string] | null {
  const [a, b] = links;
  return a !== undefined && b !== undefined ? [a, b] : null;
}

/** Returns the range of a joint. A missing limit is null in JSON, and infinite here. */
export function range_of(joint: CellJoint): [lower: number, upper: number] {
  return [joint.lower ?? -Infinity, joint.upper ?? Infinity];
}

/** Returns the shape of an object, or null if the page does not know its shape. */
export function shape_of(object: SceneObject): Shape | null {
  const { box, cylinder, sphere, mesh, scale } = object;
  if (box) return { kind: 'box', size: box };
  if (cylinder) return { kind: 'cylinder', radius: cylinder[0], length: cylinder[1] };
  if (sphere) return { kind: 'sphere', radius: sphere[0] };
  if (mesh !== undefined) return { kind: 'mesh', address: mesh, scale: scale ?? [1, 1, 1] };
  return null;
}

export type ParsedMessage =
  | { kind: 'message'; message: Message }
  | { kind: 'unknown'; type: string; stream: string | null; seq: number | null }
  | { kind: 'malformed'; fault: string };

/** True if the schemas from which this page was built include replanning. */
export const kCanReplan = 'replan' in shapes.Job.properties;

// The schema of each message type.
const kSchemaOfType = new Map<string, string>(Object.entries(shapes.Message.discriminator.mapping));

export function parse_message(text: string): ParsedMessage {
  let root: unknown;
  try {
    root = JSON.parse(text);
  } catch (error) {
    return { kind: 'malformed', fault: `not JSON: ${String(error)}` };
  }
  const { type, stream, seq } = (root ?? {}) as Record<string, unknown>;
  if (typeof type !== 'string') return { kind: 'malformed', fault: '/type: expected a string' };
  const schema = kSchemaOfType.get(type)?.split('/').at(-1);
  if (schema === undefined) {
    return {
      kind: 'unknown', type,
      stream: typeof stream === 'string' ? stream : null, seq: typeof seq === 'number' ? seq : null,
    };
  }
  if (type === 'scene') add_held(root);
  const checked = check(schema as 'JobEvent', root);
  return checked.ok ? { kind: 'message', message: checked.value } : { kind: 'malformed', fault: checked.fault };
}

/** Adds an empty list of held objects to a scene event of an old recording, which has none. */
function add_held(root: unknown): void {
  const { data } = root as { data?: Record<string, unknown> | null };
  if (typeof data === 'object' && data !== null) data['held'] ??= [];
}

export const parse_cell = (value: unknown): Parsed<Cell> => check('Cell', value);
export const parse_job = (value: unknown): Parsed<Job> => check('Job', value);
export const parse_scene = (value: unknown): Parsed<Scene> => check('Scene', value);
export const parse_job_page = (value: unknown): Parsed<JobPage> => check('JobPage', value);
export const parse_diagram = (value: unknown): Parsed<Diagram> => check('Diagram', value);
export const parse_forecast = (value: unknown): Parsed<Forecast> => check('Timeline', value);
export const parse_job_motion = (value: unknown): Parsed<JobMotion> => check('JobMotion', value);
export const parse_plan = (value: unknown): Parsed<Plan> => check('Plan', value);
export const parse_alerts = (value: unknown): Parsed<AlertList> => check('AlertList', value);
export const parse_session = (value: unknown): Parsed<Session> => check('Session', value);
export const parse_comparison = (value: unknown): Parsed<Comparison> => check('Comparison', value);
export const parse_control = (value: unknown): Parsed<Control> => check('Control', value);
export const parse_control_taken = (value: unknown): Parsed<ControlTaken> => check('ControlTaken', value);
export const parse_fault = (value: unknown): Parsed<Fault> => check('Fault', value);
export function parse_faults(value: unknown): Parsed<Fault[]> {
  const { faults } = (value ?? {}) as { faults?: unknown };
  if (!Array.isArray(faults)) return { ok: false, fault: '/faults: expected an array' };
  const parsed = faults.map(parse_fault);
  const wrong = parsed.findIndex(({ ok }) => !ok);
  const first = parsed[wrong];
  if (first && !first.ok) return { ok: false, fault: `/faults/${wrong}${first.fault}` };
  return { ok: true, value: faults as Fault[] };
}
export const parse_jog = (value: unknown): Parsed<Jog> => check('Jog', value);
export const parse_verdict = (value: unknown): Parsed<Verdict> => check('Verdict', value);
export const parse_measured_states = (value: unknown): Parsed<MeasuredStates> => check('MeasuredStates', value);
export const parse_recording_list = (value: unknown): Parsed<RecordingList> => check('RecordingList', value);
export const parse_problem = (value: unknown): Parsed<Problem> => check('Problem', value);
