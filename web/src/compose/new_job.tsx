// The New job page: paste, drop or plan a job or a batch; check it; send it. A batch is accepted as
// a whole or not at all.

import { useEffect, useMemo, useState } from 'preact/hooks';
import { InSight } from '../frame/in_sight';
import { asked_of, Copy } from '../jobs/copy';
import { curl_to_post, python_to_post } from '../jobs/snippets';
import { Link } from '../route/link';
import { kApi } from '../server/api';
import type { Problem } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { why_not_connected } from '../wording';
import { read_batch, type Batch } from './batch';
import { composed, type Composed } from './composed';
import { example_job, pretty } from './example';
import { has_goal, paths_to_goals, type GoalPaths } from './goals';
import { CheckResults, check_all, type CheckResult } from './check_results';
import { motion_of, motion_of_parts } from '../motion/pasted';
import { composed_in_worker, kLong } from './long_text';
import { PlanForm } from './plan_form';
import { Preview, type Chosen } from './preview';
import { Refused } from './refused';
import { TextField } from './text_field';
import { kText } from '../strings';

const kWords = kText.compose;

type Outcome =
  | { kind: 'none' } | { kind: 'busy'; what: string } | { kind: 'accepted'; ids: string[] }
  | { kind: 'refused'; problem: Problem } | { kind: 'checked'; results: CheckResult[] };

/** The outcome and the previewed time for the text `of`. They are not shown for another text. */
interface Found { of: string; outcome: Outcome; chosen: Chosen | null }

const kTyped_ms = 500;
const kNothingFound: Omit<Found, 'of'> = { outcome: { kind: 'none' }, chosen: null };

export function NewJob({ app }: { app: App }) {
  const text = app.draft.value;
  const [found, set_found] = useState<Found>({ of: text, ...kNothingFound });
  const { outcome, chosen } = found.of === text ? found : kNothingFound;
  const set_outcome = (next: Outcome) => set_found({ of: text, outcome: next, chosen });
  const set_chosen = (next: Chosen) => set_found({ of: text, outcome, chosen: next });
  const change = (next: string) => { app.draft.value = next.replace(/^\uFEFF/, ''); };  // some editors write a byte order mark
  const show_end = (next: string) => set_found({ of: next, outcome: { kind: 'none' }, chosen: { t_s: motion_of(read_batch(next))?.duration_s ?? 0 } });
  const made = use_composed(text);
  const batch = useMemo(() => read_batch(text.length > kLong ? '' : text), [text]);  // goals are planned only if the text is short
  const paths = use_goal_paths(batch, app);
  const motion = useMemo(() => (paths.kind === 'planned' ? motion_of(paths.paths.batch) : motion_of_parts(made?.parts ?? [])), [made, paths]);
  // Shows the end of the path once a goal is planned.
  useEffect(() => { if (paths.kind === 'planned' && paths.paths.planned > 0 && motion) set_chosen({ t_s: motion.duration_s }); }, [paths]);
  const unheard = why_not_connected(app.store.link);
  const why_disabled = why_no_command(app);
  const busy = made === null || text.trim() === '' || outcome.kind === 'busy';
  const idle = busy || unheard !== null;
  // Sending the same text again submits another job, so only the button "Send again" does it.
  const is_sent = outcome.kind === 'accepted';
  const send = async () => {
    if (busy || why_disabled !== null) return;
    set_outcome({ kind: 'busy', what: kWords.sending });
    set_outcome(await sent(made, app));
  };
  const check = async () => {
    if (idle) return;
    set_outcome({ kind: 'busy', what: kWords.checking });
    set_outcome({ kind: 'checked', results: await check_all(made.bodies, app.api) });
  };
  return (
    <div class="page compose">
      <h2>{kText.page.new}</h2>
      <p class="hint">
        {kWords.hint_format}<code>POST {kApi}/jobs</code>{kWords.hint_trajectory}<code>trajectory_msgs/JointTrajectory</code>{kWords.hint_batch}
      </p>
      <details class="plan-goal" data-test="plan-goal">
        <summary>{kWords.plan_goal}</summary>
        <PlanForm app={app} change={(next) => { change(next); show_end(next); }} />
      </details>
      <Examples app={app} change={change} />
      <TextField text={text} change={change} send={() => { if (!is_sent) void send(); }} />
      {is_yaml(text) && <p class="hint" data-test="yaml">{kWords.yaml}<code>python3 -c 'import json, sys, yaml; json.dump(yaml.safe_load(sys.stdin), sys.stdout)' &lt; job.yaml</code></p>}
      {motion && <Preview motion={motion} app={app} chosen={chosen} />}
      {paths.kind !== 'none' && <GoalPathsHint paths={paths} />}
      <div class="line">
        <span class="grow dim small" data-test="batch">{made === null ? kWords.reading : kind_in_words(made)}</span>
        <button data-test="check-job" title={kWords.check_title} disabled={idle} onClick={() => void check()}>{kWords.check}</button>
        <button class={is_sent ? '' : 'primary'} data-test="send" title={why_disabled ?? (is_sent ? kWords.send_again_title : '')} disabled={busy || why_disabled !== null}
          onClick={(event) => { if (event.detail < 2) void send(); /* ignores the second click of a double click */ }}>
          {outcome.kind === 'busy' ? outcome.what : `${made?.kind === 'batch' ? kWords.send_all : kWords.send}${is_sent ? kWords.send_again : ''}`}
        </button>
      </div>
      {made && text.trim() !== '' && <Copies made={made} app={app} />}
      <InSight answer={outcome.kind === 'none' || outcome.kind === 'busy' ? null : outcome}>
        {outcome.kind === 'accepted' && <Accepted ids={outcome.ids} app={app} />}
        {outcome.kind === 'checked' && <CheckResults results={outcome.results} show={motion && made?.kind === 'one' ? (t_s) => set_chosen({ t_s }) : null} />}
        {outcome.kind === 'refused' && <Refused problem={outcome.problem} />}
      </InSight>
    </div>
  );
}

/** Returns the composed text, or null while a long text is read. */
function use_composed(text: string): Composed | null {
  const [read, set_read] = useState<{ of: string; made: Composed } | null>(null);
  const is_long = text.length > kLong;
  useEffect(() => {
    if (!is_long) return;
    const stop = new AbortController();
    composed_in_worker(text, stop.signal).then((made) => set_read({ of: text, made }), () => undefined /* the reading was canceled */);
    return () => stop.abort();
  }, [text, is_long]);
  return useMemo(() => (!is_long ? composed(text) : read?.of === text ? read.made : null), [text, is_long, read]);
}

/** Returns true if the text begins with a YAML key or document marker. */
export function is_yaml(text: string): boolean {
  return /^\s*(---|[A-Za-z_]\w*:)(\s|$)/.test(text.slice(0, 200));
}

function kind_in_words({ kind, bodies }: Composed): string {
  return kind === 'batch' ? kWords.batch(bodies.length) : kWords.send_key;
}

type GoalPathsState = { kind: 'none' } | { kind: 'planning' } | { kind: 'planned'; paths: GoalPaths };

/** Plans the pasted goals once typing has stopped. */
function use_goal_paths(batch: Batch, app: App): GoalPathsState {
  const { store, api } = app;
  const [state, set_state] = useState<{ of: Batch; paths: GoalPaths } | null>(null);
  const asks = store.link.status === 'open' && has_goal(batch, store);
  useEffect(() => {
    if (!asks) return;
    let closed = false;
    const timer = setTimeout(() => {
      void paths_to_goals(batch, store, api).then((paths) => { if (!closed) set_state({ of: batch, paths }); });
    }, kTyped_ms);
    return () => {
      closed = true;
      clearTimeout(timer);
    };
  }, [batch, asks, store, api]);
  return useMemo(() => (state?.of === batch ? { kind: 'planned', paths: state.paths } : { kind: asks ? 'planning' : 'none' }), [state, batch, asks]);
}

function GoalPathsHint({ paths }: { paths: Exclude<GoalPathsState, { kind: 'none' }> }) {
  if (paths.kind === 'planning') return <p class="hint" role="status" data-test="goal-path">{kWords.planning_goal}</p>;
  const { planned, left_out, problem } = paths.paths;
  return (
    <>
      {planned > 0 && <p class="hint" role="status" data-test="goal-path">{kWords.path_shown(planned)}{left_out > 0 && kWords.goals_left_out(left_out)}</p>}
      {problem && <div data-test="goal-problem"><p class="small">{kWords.no_path}</p><Refused problem={problem} /></div>}
    </>
  );
}

function Examples({ app, change }: { app: App; change(text: string): void }) {
  const { store } = app;
  const idle = [...store.arms.values()].filter((arm) => arm.state === 'idle' && arm.job === null);
  return (
    <div class="line wrap">
      <span class="dim">{idle.length === 0 ? kWords.no_idle_arm : kWords.example_for}</span>
      {idle.map((arm) => (
        <button key={arm.name} class="small" data-test={`example-${arm.name}`}
          onClick={() => change(pretty(example_job(arm, store.q_of(arm), store.cell?.joints ?? [])))}>{arm.name}</button>
      ))}
    </div>
  );
}

/** Copies the same request as a curl command or a Python program. */
function Copies({ made: { request: { path, body } }, app }: { made: Composed; app: App }) {
  const with_it = (make: typeof curl_to_post) => async () => make(path, await body.text(), asked_of(app));
  return (
    <div class="line">
      <span class="grow dim small">{kWords.same_for_programs}</span>
      <Copy what="curl" text={with_it(curl_to_post)} />
      <Copy what="Python" text={with_it(python_to_post)} />
    </div>
  );
}

function Accepted({ ids, app }: { ids: string[]; app: App }) {
  return (
    <p class="accepted" role="status" data-test="accepted">
      {ids.length === 0 ? `${kWords.accepted}.` : kWords.accepted_as}
      {ids.map((id, i) => <span key={id}>{i === 0 ? '' : ', '}<Link app={app} to={{ page: 'job', id }}>{id}</Link></span>)}
    </p>
  );
}

async function sent({ request: { path, body } }: Composed, app: App): Promise<Outcome> {
  const answer = path === '/batches' ? await app.api.post_batch(body) : await app.api.post_job(body);
  return answer.ok ? { kind: 'accepted', ids: ids_of(answer.value) } : { kind: 'refused', problem: answer.problem };
}

/** Returns the ids of the accepted job or jobs. */
function ids_of(answer: unknown): string[] {
  const { id, jobs } = (answer ?? {}) as { id?: unknown; jobs?: unknown };
  if (typeof id === 'string') return [id];
  return Array.isArray(jobs) ? jobs.flatMap(ids_of) : [];
}
