// The HTTP requests of the page. Each answer is a value or a problem.

import { cut_text } from '../names';
import { kText } from '../strings';
import {
  parse_alerts, parse_cell, parse_comparison, parse_control, parse_control_taken, parse_diagram, parse_fault, parse_faults, parse_jog, parse_forecast, parse_job, parse_job_motion, parse_job_page, parse_measured_states, parse_plan, parse_problem, parse_recording_list, parse_scene, parse_session, parse_verdict,
  type AlertList, type Cell, type Comparison, type Control, type ControlTaken, type Diagram, type Fault, type FaultRequest, type Forecast, type Jog, type Job, type JobAmendment, type JobMotion, type JobPage, type MeasuredStates, type Parsed, type Plan, type Problem, type RecordingList, type Scene, type SceneObject, type Session, type SignalValue, type Verdict,
} from './messages';

const kAnswers = kText.server.answers;

export type Answer<T> = { ok: true; value: T } | { ok: false; problem: Problem };
export type Fetch = (url: string, init?: RequestInit) => Promise<Response>;

/** The prefix of all API paths on the server. */
export const kApi = '/api/v1';

/**
 * Returns the address of a path of the server. It is relative to the page, because a reverse proxy
 * may serve the page below a path: "/api/v1" is then "/cells/a/api/v1".
 */
export function address_on_server(path: string, page = document.baseURI): string {
  return new URL(path.replace(/^\/+/, ''), page).href;
}

export class Api {
  constructor(private readonly base_: string, private readonly fetch_: Fetch) {}

  async cell(): Promise<Answer<Cell>> {
    return checked(kAnswers.cell, await this.ask('GET', '/cell'), parse_cell);
  }

  async scene(): Promise<Answer<Scene>> {
    return checked(kAnswers.scene, await this.ask('GET', '/scene'), parse_scene);
  }

  async job(id: string): Promise<Answer<Job>> {
    return checked(kAnswers.job, await this.ask('GET', `/jobs/${encodeURIComponent(id)}`), parse_job);
  }

  /**
   * Returns a page of the job list, which includes previous sessions. A null cursor gives the
   * newest page.
   */
  async jobs(limit: number, cursor: string | null): Promise<Answer<JobPage>> {
    const from = cursor === null ? '' : `&cursor=${encodeURIComponent(cursor)}`;
    return checked(kAnswers.jobs, await this.ask('GET', `/jobs?limit=${limit}${from}`), parse_job_page);
  }

  async job_motion(id: string): Promise<Answer<JobMotion>> {
    return checked(kAnswers.trajectory, await this.ask('GET', `/jobs/${encodeURIComponent(id)}/trajectory`), parse_job_motion);
  }

  async timeline(): Promise<Answer<Forecast>> {
    return checked(kAnswers.timeline, await this.ask('GET', '/timeline'), parse_forecast);
  }

  /**
   * Returns the diagram of two jobs. If `cells` is false, the server leaves out the cells, and only
   * the prediction is of use.
   */
  async diagram(a: string, b: string, cells = true): Promise<Answer<Diagram>> {
    const path = `/jobs/${encodeURIComponent(a)}/diagram?with=${encodeURIComponent(b)}${cells ? '' : '&cells=0'}`;
    return checked(kAnswers.diagram, await this.ask('GET', path), parse_diagram);
  }

  /** Posts the body unchanged. The server validates it, including that it is JSON. */
  post_job(body: Blob | string): Promise<Answer<unknown>> {
    return this.ask('POST', '/jobs', body);
  }

  /** Submits a batch: either all jobs are accepted or none. */
  post_batch(body: Blob | string): Promise<Answer<unknown>> {
    return this.ask('POST', '/batches', body);
  }

  /** Checks a job as if it were submitted now; nothing is stored. */
  async check(body: Blob | string): Promise<Answer<Verdict>> {
    return checked(kAnswers.verdict, await this.ask('POST', '/check', body), parse_verdict);
  }

  /** Plans a path to a goal; nothing is stored and nothing moves. */
  async plan(text: string): Promise<Answer<Plan>> {
    return checked(kAnswers.plan, await this.ask('POST', '/plan', text), parse_plan);
  }

  put_object(object: SceneObject): Promise<Answer<unknown>> {
    const { name, ...rest } = object;
    return this.ask('PUT', `/scene/objects/${encodeURIComponent(name)}`, JSON.stringify(rest));
  }

  remove_object(name: string): Promise<Answer<unknown>> {
    return this.ask('DELETE', `/scene/objects/${encodeURIComponent(name)}`);
  }

  /** The arm does not hold the object any more, which is part of the scene. */
  detach_object(name: string): Promise<Answer<unknown>> {
    return this.ask('POST', `/scene/objects/${encodeURIComponent(name)}/detach`);
  }

  /** Changes the given members of a job. */
  amend_job(id: string, changes: JobAmendment): Promise<Answer<unknown>> {
    return this.ask('PATCH', `/jobs/${encodeURIComponent(id)}`, JSON.stringify(changes));
  }

  cancel_job(id: string): Promise<Answer<unknown>> {
    return this.ask('DELETE', `/jobs/${encodeURIComponent(id)}`);
  }

  /** Plans a new path to the job's goal. */
  replan_job(id: string): Promise<Answer<unknown>> {
    return this.ask('POST', `/jobs/${encodeURIComponent(id)}/replan`);
  }

  /** Sets an output, or a simulated input. */
  set_signal(name: string, value: SignalValue): Promise<Answer<unknown>> {
    return this.ask('PUT', `/io/${encodeURIComponent(name)}`, JSON.stringify({ value }));
  }

  /** Changes the scheduling policy. The server refuses this while a job is admitted. */
  change_policy(policy: string): Promise<Answer<unknown>> {
    return this.ask('PUT', '/policy', JSON.stringify({ policy }));
  }

  /** Starts the comparison of all policies on recent jobs. */
  async compare(what: { since_s?: number }): Promise<Answer<Comparison>> {
    return checked(kAnswers.comparison, await this.ask('POST', '/comparison', JSON.stringify(what)), parse_comparison);
  }

  async comparison(): Promise<Answer<Comparison>> {
    return checked(kAnswers.comparison, await this.ask('GET', '/comparison'), parse_comparison);
  }

  async cancel_comparison(): Promise<Answer<Comparison>> {
    return checked(kAnswers.comparison, await this.ask('DELETE', '/comparison'), parse_comparison);
  }

  async control(): Promise<Answer<Control>> {
    return checked(kAnswers.control, await this.ask('GET', '/control'), parse_control);
  }

  /** Takes control for jogging. If `who` is empty, the server uses the client's address as name. */
  async take_control(who: string): Promise<Answer<ControlTaken>> {
    const asked = who === '' ? { take: true } : { who, take: true };
    return checked(kAnswers.control, await this.ask('POST', '/control', JSON.stringify(asked)), parse_control_taken);
  }

  async release_control(key: string): Promise<Answer<Control>> {
    return checked(kAnswers.control, await this.ask('POST', '/control/release', JSON.stringify({ control: key })), parse_control);
  }

  /** Starts a jog motion. The motion lasts only while its lease is renewed. */
  async jog(arm: string, state: string, key: string): Promise<Answer<Jog>> {
    const asked = { control: key, to: { named: state } };
    return checked(kAnswers.jog_motion, await this.ask('POST', `/arms/${encodeURIComponent(arm)}/jog`, JSON.stringify(asked)), parse_jog);
  }

  async renew_jog(arm: string, key: string): Promise<Answer<Jog>> {
    return checked(kAnswers.jog_motion, await this.ask('PUT', `/arms/${encodeURIComponent(arm)}/jog`, JSON.stringify({ control: key })), parse_jog);
  }

  /** Returns the present faults, or null if the server is too old to list them. */
  async faults(): Promise<Answer<Fault[] | null>> {
    const answer = await this.ask('GET', '/sim/faults');
    if (!answer.ok && (answer.problem.status === 404 || answer.problem.status === 405)) return { ok: true, value: null };
    return checked(kAnswers.faults, answer, parse_faults);
  }

  /** Injects a fault into a simulated arm. */
  async inject(fault: FaultRequest): Promise<Answer<Fault>> {
    return checked(kAnswers.fault, await this.ask('POST', '/sim/faults', JSON.stringify(fault)), parse_fault);
  }

  remove_fault(id: string): Promise<Answer<unknown>> {
    return this.ask('DELETE', `/sim/faults/${encodeURIComponent(id)}`);
  }

  stop(): Promise<Answer<unknown>> {
    return this.ask('POST', '/stop');
  }

  resume(): Promise<Answer<unknown>> {
    return this.ask('POST', '/resume');
  }

  /** Sets the speed override of an arm, or of the cell if `arm` is null. */
  set_speed_override(arm: string | null, share: number): Promise<Answer<unknown>> {
    const path = arm === null ? '/speed' : `/arms/${encodeURIComponent(arm)}/speed`;
    return this.ask('PUT', path, JSON.stringify({ speed_override: share }));
  }

  stop_arm(name: string): Promise<Answer<unknown>> {
    return this.ask('POST', `/arms/${encodeURIComponent(name)}/stop`);
  }

  resume_arm(name: string): Promise<Answer<unknown>> {
    return this.ask('POST', `/arms/${encodeURIComponent(name)}/resume`);
  }

  async alerts(): Promise<Answer<AlertList>> {
    return checked(kAnswers.alerts, await this.ask('GET', '/alerts'), parse_alerts);
  }

  /** Acknowledges alerts. If `who` is empty, the server uses the client's address as name. */
  acknowledge(ids: readonly string[], who: string): Promise<Answer<unknown>> {
    return this.ask('POST', '/alerts/acknowledge', JSON.stringify(who === '' ? { ids } : { ids, who }));
  }

  /** Returns the measured positions of the last minutes. */
  async states(): Promise<Answer<MeasuredStates>> {
    return checked(kAnswers.positions, await this.ask('GET', '/states'), parse_measured_states);
  }

  /** Newest first. */
  async recordings(): Promise<Answer<RecordingList>> {
    return checked(kAnswers.recordings, await this.ask('GET', '/recordings'), parse_recording_list);
  }

  /** Returns the address of a recording's file. */
  recording_address(recording: string, file: string): string {
    return `${this.base_}/recordings/${encodeURIComponent(recording)}/${encodeURIComponent(file)}`;
  }

  async session(): Promise<Answer<Session>> {
    return checked(kAnswers.session, await this.ask('GET', '/session'), parse_session);
  }

  log_out(): Promise<Answer<unknown>> {
    return this.ask('DELETE', '/session');
  }

  private async ask(method: string, path: string, body?: Blob | string): Promise<Answer<unknown>> {
    const init: RequestInit = { method, headers: { accept: 'application/json' } };
    if (body !== undefined) {
      init.body = body;
      init.headers = { accept: 'application/json', 'content-type': 'application/json' };
    }
    try {
      const response = await this.fetch_(this.base_ + path, init);
      const text = await response.text();
      if (response.ok) return { ok: true, value: text === '' ? null : (JSON.parse(text) as unknown) };
      return { ok: false, problem: read_problem(text, response) };
    } catch (error) {
      return { ok: false, problem: own_problem(kText.server.no_answer, String(error)) };
    }
  }
}

function checked<T>(what: string, answer: Answer<unknown>, parse: (value: unknown) => Parsed<T>): Answer<T> {
  if (!answer.ok) return answer;
  const parsed = parse(answer.value);
  return parsed.ok
    ? { ok: true, value: parsed.value }
    : { ok: false, problem: own_problem(kText.server.unreadable(what), parsed.fault) };
}

function read_problem(text: string, response: Response): Problem {
  try {
    const problem = parse_problem(JSON.parse(text));
    if (problem.ok) return problem.value;
  } catch {
    // The answer is not JSON; it comes from a proxy, for example. Its text is shown unchanged.
  }
  return { ...own_problem(response.statusText || kText.server.refused, cut_text(text, 300)), status: response.status };
}

function own_problem(title: string, detail: string): Problem {
  return { type: 'about:blank', title, status: 0, detail };
}
