// Compose: paste, drop or begin from an example; see it judged as things are; send it. One job, or a bag
// of jobs, which is taken whole or not at all.

import { useEffect, useMemo, useState } from 'preact/hooks';
import { InSight } from '../frame/in_sight';
import { asked_of, Copy } from '../jobs/copy';
import { curl_to_post, python_to_post } from '../jobs/snippets';
import { Link } from '../route/link';
import { kApi } from '../server/api';
import type { Problem } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { why_mute } from '../wording';
import { read_bag, type Bag } from './bag';
import { composed, type Composed } from './composed';
import { example_job, pretty } from './example';
import { has_goal, ways_to_goals, type Ways } from './goals';
import { Judged, judge_all, type Judgement } from './judged';
import { motion_of, motion_of_parts } from '../motion/pasted';
import { composed_beside, kLong } from './long_text';
import { PlanForm } from './plan_form';
import { Preview, type Chosen } from './preview';
import { Refused } from './refused';
import { TextField } from './text_field';
import { kText } from '../strings';

const kWords = kText.compose;

type Outcome =
  | { kind: 'none' } | { kind: 'busy'; what: string } | { kind: 'accepted'; ids: string[] }
  | { kind: 'refused'; problem: Problem } | { kind: 'judged'; judgements: Judgement[] };

/** What was found out, and which instant is previewed; of another text it says nothing. */
interface Said { of: string; outcome: Outcome; chosen: Chosen | null }

const kTyped_ms = 500;
const kNothingSaid: Omit<Said, 'of'> = { outcome: { kind: 'none' }, chosen: null };

export function NewJob({ app }: { app: App }) {
  const text = app.draft.value;
  const [said, set_said] = useState<Said>({ of: text, ...kNothingSaid });
  const { outcome, chosen } = said.of === text ? said : kNothingSaid;
  const set_outcome = (next: Outcome) => set_said({ of: text, outcome: next, chosen });
  const set_chosen = (next: Chosen) => set_said({ of: text, outcome, chosen: next });
  const change = (next: string) => { app.draft.value = next.replace(/^\uFEFF/, ''); };  // some editors begin files by it
  const show_end = (next: string) => set_said({ of: next, outcome: { kind: 'none' }, chosen: { t_s: motion_of(read_bag(next))?.duration_s ?? 0 } });
  const made = use_composed(text);
  const bag = useMemo(() => read_bag(text.length > kLong ? '' : text), [text]);  // ways to goals are shown of short ones
  const ways = use_ways(bag, app);
  const motion = useMemo(() => (ways.kind === 'planned' ? motion_of(ways.ways.bag) : motion_of_parts(made?.parts ?? [])), [made, ways]);
  // Where a goal leads is shown as soon as there is a way.
  useEffect(() => { if (ways.kind === 'planned' && ways.ways.planned > 0 && motion) set_chosen({ t_s: motion.duration_s }); }, [ways]);
  const unheard = why_mute(app.store.link);
  const mute = why_no_command(app);
  const busy = made === null || text.trim() === '' || outcome.kind === 'busy';
  const idle = busy || unheard !== null;
  // The same once more is another job: it has to be asked for by the button that says so.
  const is_sent = outcome.kind === 'accepted';
  const send = async () => {
    if (busy || mute !== null) return;
    set_outcome({ kind: 'busy', what: kWords.sending });
    set_outcome(await sent(made, app));
  };
  const judge = async () => {
    if (idle) return;
    set_outcome({ kind: 'busy', what: kWords.checking });
    set_outcome({ kind: 'judged', judgements: await judge_all(made.bodies, app.api) });
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
      {ways.kind !== 'none' && <WaysSaid ways={ways} />}
      <div class="line">
        <span class="grow dim small" data-test="bag">{made === null ? kWords.reading : kind_in_words(made)}</span>
        <button data-test="judge" title={kWords.check_title} disabled={idle} onClick={() => void judge()}>{kWords.check}</button>
        <button class={is_sent ? '' : 'primary'} data-test="send" title={mute ?? (is_sent ? kWords.send_again_title : '')} disabled={busy || mute !== null}
          onClick={(event) => { if (event.detail < 2) void send(); /* not by the second click of a double one */ }}>
          {outcome.kind === 'busy' ? outcome.what : `${made?.kind === 'bag' ? kWords.send_all : kWords.send}${is_sent ? kWords.send_again : ''}`}
        </button>
      </div>
      {made && text.trim() !== '' && <Copies made={made} app={app} />}
      <InSight answer={outcome.kind === 'none' || outcome.kind === 'busy' ? null : outcome}>
        {outcome.kind === 'accepted' && <Accepted ids={outcome.ids} app={app} />}
        {outcome.kind === 'judged' && <Judged judgements={outcome.judgements} show={motion && made?.kind === 'one' ? (t_s) => set_chosen({ t_s }) : null} />}
        {outcome.kind === 'refused' && <Refused problem={outcome.problem} />}
      </InSight>
    </div>
  );
}

/** What the text comes to; null: a long one is being read. */
function use_composed(text: string): Composed | null {
  const [read, set_read] = useState<{ of: string; made: Composed } | null>(null);
  const is_long = text.length > kLong;
  useEffect(() => {
    if (!is_long) return;
    const stop = new AbortController();
    composed_beside(text, stop.signal).then((made) => set_read({ of: text, made }), () => undefined /* given up */);
    return () => stop.abort();
  }, [text, is_long]);
  return useMemo(() => (!is_long ? composed(text) : read?.of === text ? read.made : null), [text, is_long, read]);
}

/** It begins with a key, or with the line that begins a document. */
export function is_yaml(text: string): boolean {
  return /^\s*(---|[A-Za-z_]\w*:)(\s|$)/.test(text.slice(0, 200));
}

function kind_in_words({ kind, bodies }: Composed): string {
  return kind === 'bag' ? kWords.batch(bodies.length) : kWords.send_key;
}

type WaysState = { kind: 'none' } | { kind: 'planning' } | { kind: 'planned'; ways: Ways };

/** The ways to the goals that are pasted, asked for once nobody types any more. */
function use_ways(bag: Bag, app: App): WaysState {
  const { store, api } = app;
  const [state, set_state] = useState<{ of: Bag; ways: Ways } | null>(null);
  const asks = store.link.status === 'open' && has_goal(bag, store);
  useEffect(() => {
    if (!asks) return;
    let closed = false;
    const timer = setTimeout(() => {
      void ways_to_goals(bag, store, api).then((ways) => { if (!closed) set_state({ of: bag, ways }); });
    }, kTyped_ms);
    return () => {
      closed = true;
      clearTimeout(timer);
    };
  }, [bag, asks, store, api]);
  return useMemo(() => (state?.of === bag ? { kind: 'planned', ways: state.ways } : { kind: asks ? 'planning' : 'none' }), [state, bag, asks]);
}

function WaysSaid({ ways }: { ways: Exclude<WaysState, { kind: 'none' }> }) {
  if (ways.kind === 'planning') return <p class="hint" role="status" data-test="goal-way">{kWords.planning_goal}</p>;
  const { planned, left_out, problem } = ways.ways;
  return (
    <>
      {planned > 0 && <p class="hint" role="status" data-test="goal-way">{kWords.path_shown(planned)}{left_out > 0 && kWords.goals_left_out(left_out)}</p>}
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

/** The same request for a terminal or a program. */
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

/** The job, or each of the bag's. */
function ids_of(answer: unknown): string[] {
  const { id, jobs } = (answer ?? {}) as { id?: unknown; jobs?: unknown };
  if (typeof id === 'string') return [id];
  return Array.isArray(jobs) ? jobs.flatMap(ids_of) : [];
}
