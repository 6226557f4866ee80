// What the server says, as types, and the only place where its JSON is read. The types are made from
// the server's own description (src/contract, `npm run contract`); so are the shapes that JSON is
// checked by.
//
// Messages on the WebSocket form one union discriminated by `type`. `parse_message` never throws:
// it answers the message, or that the type is unknown (a newer server), or what is malformed and
// where. Times are seconds of cell time, angles rad, lengths m, as in the server's contract.

import { check, type Parsed, type Schemas } from './check';
import shapes from '../contract/schemas.json';

export type { Parsed };
export type ArmState = Schemas['ArmState'];
export type JobState = Schemas['JobState'];
export type Arm = Schemas['Arm'];
/** One thing that a job waits on; times count from the start of each one's own trajectory. */
export type WaitsOn = Schemas['Wait'];
export type Job = Schemas['Job'];
export type SceneObject = Schemas['Object'];
export type Cell = Schemas['Cell'];
export type CellArm = Schemas['CellArm'];
export type CellRobot = Schemas['CellRobot'];
export type CellJoint = Schemas['CellJoint'];
/** The coordination diagram of two jobs. */
export type Diagram = Schemas['Diagram'];
/** What one arm of A and one arm of B do to each other, wherever each is on its way. */
export type DiagramLayer = Diagram['layers'][number];
/** What the two meet if both go on from where they are. */
export type DiagramContact = Schemas['DiagramContact'];
export type CellState = Schemas['DiagramCell']['state'];
/** When each arm is expected to move. */
export type Forecast = Schemas['Timeline'];
export type ForecastStep = Schemas['TimelineStep'];
/** What the admission code says of a job that was only asked about. */
export type Verdict = Schemas['Verdict'];
/** What of a job can be changed. */
export type JobAmendment = Partial<Pick<Job, 'name' | 'priority' | 'backlog_timeout_s' | 'on_timeout'>>;
/** How a job moves. */
export type JobMotion = Schemas['JobMotion'];
/** A motion to a goal, which is not executed. */
export type Plan = Schemas['Plan'];
/** What somebody has to see to, until somebody has. */
export type KeptAlert = Schemas['KeptAlert'];
export type AlertList = Schemas['AlertList'];
/** Who asks, and what they may. */
export type Session = Schemas['Session'];
/** The same jobs under several policies, simulated. */
export type Comparison = Schemas['Comparison'];
export type PolicyRun = Schemas['PolicyRun'];
/** Who may jog arms. */
export type Control = Schemas['Control'];
export type ControlTaken = Schemas['ControlTaken'];
export type ControlHolder = Schemas['ControlHolder'];
/** A jog motion. */
export type Jog = Schemas['Jog'];
/** Of all jobs that the server has, newest first. */
export type JobPage = Schemas['JobPage'];
/** Where every joint was measured over the last minutes. */
export type MeasuredStates = Schemas['MeasuredStates'];
/** What runs of the server have written down. */
export type RecordingList = Schemas['RecordingList'];
export type KeptRecording = Schemas['Recording'];
export type QueueData = Schemas['QueueIds'];
export type MonitorData = Schemas['MonitorFinding'];
/** RFC 9457, with the place of the fault and the value found. */
export type Problem = Schemas['Problem'];
export type Message = Schemas['Message'];
/** A frame of poses: carries no sequence number and may be dropped on the way. */
export type StateMessage = Schemas['StateFrame'];
export type SequencedMessage = Exclude<Message, StateMessage>;
/** The smallest distance of a pair: two arms, or one arm and an object of the scene. */
export type Clearance = StateMessage['clearance'][number];
/** What an arm may do of a motion: how far it is, how far it may go; trajectory time. */
export type ArmAuthority = Schemas['ArmAuthority'];

export type Shape =
  | { kind: 'box'; size: [number, number, number] }
  | { kind: 'cylinder'; radius: number; length: number }
  | { kind: 'sphere'; radius: number }
  /** Served at `address` by the same server; in metres once scaled. */
  | { kind: 'mesh'; address: string; scale: [number, number, number] };

/** Two links; null where there are none. */
export function pair_of(links: readonly string[]): [string, string] | null {
  const [a, b] = links;
  return a !== undefined && b !== undefined ? [a, b] : null;
}

/** Where a joint may be; infinite where it has no limit, which JSON calls null. */
export function range_of(joint: CellJoint): [lower: number, upper: number] {
  return [joint.lower ?? -Infinity, joint.upper ?? Infinity];
}

/** null for a shape that this page does not know. */
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

/** Whether this server can look for another way for a job: its jobs then tell of it. */
export const kCanReplan = 'replan' in shapes.Job.properties;

// Which schema each type of message has.
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
  const checked = check(schema as 'JobEvent', root);
  return checked.ok ? { kind: 'message', message: checked.value } : { kind: 'malformed', fault: checked.fault };
}

export const parse_cell = (value: unknown): Parsed<Cell> => check('Cell', value);
export const parse_job = (value: unknown): Parsed<Job> => check('Job', value);
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
export const parse_jog = (value: unknown): Parsed<Jog> => check('Jog', value);
export const parse_verdict = (value: unknown): Parsed<Verdict> => check('Verdict', value);
export const parse_measured_states = (value: unknown): Parsed<MeasuredStates> => check('MeasuredStates', value);
export const parse_recording_list = (value: unknown): Parsed<RecordingList> => check('RecordingList', value);
export const parse_problem = (value: unknown): Parsed<Problem> => check('Problem', value);
