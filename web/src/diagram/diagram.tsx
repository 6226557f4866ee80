// The coordination diagram of two jobs. Shows which pairs of progress are free or in conflict, the
// current progress, and the prediction.

import { useEffect, useRef, useState } from 'preact/hooks';
import {
  evidence_in_words, evidence_of, drawn_in_words, kept_in_words, measured_path, plan_from, plan_in_words, shares, type Point,
} from './reading';
import { ahead_of, type Ahead } from './ahead';
import { use_fetched, use_latest } from './fetched';
import { Legend } from './legend';
import type { ArmAuthority, Diagram, Job } from '../server/messages';
import { arm_color, ink } from '../state/palette';
import { progress_at } from '../state/progress_book';
import type { Store } from '../state/store';
import { short_id } from '../wording';
import type { App } from '../state/app';
import { DiagramPicture, type Scene } from './picture';
import { Refused } from '../compose/refused';
import { is_arm, job_of_side, why_no_pair } from './sides';
import { seen_app } from '../state/as_of';
import { use_beats } from '../state/seen';
import { AsOf } from '../frame/as_of';
import { kText } from '../strings';

const kWords = kText.diagram;

const kShownFinished = 12;
const kShownOpen = 100;

interface Props { a: string; b: string; app: App }

/**
 * The diagram of two jobs or arms. If a side is an arm, the arm's job at the shown time is drawn.
 */
export function DiagramPanel({ a, b, app }: Props) {
  const { store } = seen_app(app);
  return (
    <>
      <h2>{kText.page.diagram}</h2>
      <AsOf app={app}>{app.store.link.status === 'recording'
        ? kWords.of_live_server
        : kWords.of_current_scene}</AsOf>
      <div class="pair">
        <Pick what={kWords.across} side={a} store={store} on_pick={(side) => app.router.go({ page: 'pair', a: side, b })} />
        <Pick what={kWords.up} side={b} store={store} on_pick={(side) => app.router.go({ page: 'pair', a, b: side })} />
      </div>
      <Sides key={`${a} ${b}`} a={a} b={b} app={app} />
    </>
  );
}

/** Looks up the jobs of both sides, again with every beat (state/pulse.ts). */
function Sides({ a, b, app }: Props) {
  const { store } = seen_app(app);
  use_beats(store);
  const why_not = why_no_pair(a, b, store);
  if (why_not !== null) return <p class="hint" data-test="no-pair">{store.stream === null ? kText.common.not_connected : why_not}</p>;
  return <Pair a={job_of_side(a, store)?.id ?? a} b={job_of_side(b, store)?.id ?? b} app={app} />;
}

/** The diagram of two jobs. */
function Pair({ a, b, app }: Props) {
  const { actions, api } = app;
  const then = seen_app(app);
  const { store } = then;
  const [layer, set_layer] = useState(0);
  const connected = app.store.link.status === 'open' && app.store.stream !== null;
  const { diagram, refused } = use_fetched(api, a, b, app.store.objects, connected);
  useEffect(() => set_layer(0), [diagram?.a.id, diagram?.b.id]);
  const goes_on = { a: is_followed(a, app.store), b: is_followed(b, app.store) };
  useEffect(() => (goes_on.a ? actions.follow_job(a) : undefined), [actions, a, goes_on.a]);
  useEffect(() => (goes_on.b ? actions.follow_job(b) : undefined), [actions, b, goes_on.b]);
  const is_refused = refused !== null && refused.a === a && refused.b === b;
  const jobs = { a: diagram && store.job(diagram.a.id), b: diagram && store.job(diagram.b.id) };
  const is_kept = diagram !== null && (diagram.a.id !== a || diagram.b.id !== b);
  return (
    <>
      {is_refused && <Refused problem={refused.problem} />}
      {diagram && <p class="hint" data-test={is_kept ? 'kept' : 'drawn'}>{is_kept ? kept_in_words(diagram, [jobs.a, jobs.b], is_refused ? null : { a, b }) : drawn_in_words(diagram)}</p>}
      {diagram && diagram.layers.length > 1 && (
        <div class="line">
          {diagram.layers.map(({ arms }, i) => (
            <button key={i} class="small" aria-pressed={i === layer} onClick={() => set_layer(i)}>{arms.join(' – ')}</button>
          ))}
        </div>
      )}
      {diagram && <Drawn key={`${diagram.a.id} ${diagram.b.id} ${layer}`} diagram={diagram} layer={layer} jobs={jobs} is_kept={is_kept} app={then} />}
      {!is_refused && !diagram && <p class="hint">{connected ? kWords.drawing : kWords.not_connected}</p>}
    </>
  );
}

function is_followed(id: string, store: Store): boolean {
  const job = store.job(id);
  return job !== null && !store.is_terminal(job);
}

/** Lets the user select a job, or an arm and thereby its current job. */
function Pick({ what, side, store, on_pick }: { what: string; side: string; store: Store; on_pick(side: string): void }) {
  const jobs = (['running', 'scheduled', 'backlog', 'queued'] as const).flatMap((list) => store.jobs(list)).slice(0, kShownOpen).concat(store.jobs('finished').slice(0, kShownFinished));
  const chosen = job_of_side(side, store);
  const of_arm = is_arm(side, store);
  if (chosen && !of_arm && !jobs.some((job) => job.id === side)) jobs.push(chosen);
  const names = [...store.arms.keys()];
  return (
    <label class="pick" style={{ '--arm': arm_color(names, (of_arm ? side : chosen?.arms[0]) ?? '') }}>
      <span class="small dim">{what}</span>
      <span class="swatch" />
      <select value={side} aria-label={kWords.side_label(what)} onChange={(event) => on_pick(event.currentTarget.value)}>
        {!chosen && !of_arm && <option value={side}>{side}</option>}
        <optgroup label={kWords.arms}>
          {names.filter((name) => is_arm(name, store)).map((name) => <option key={name} value={name}>{name}</option>)}
        </optgroup>
        <optgroup label={kWords.jobs}>
          {jobs.map((job) => <option key={job.id} value={job.id}>{`${short_id(job.id)} (${job.arms.join(' + ')}, ${job.state})`}</option>)}
        </optgroup>
      </select>
    </label>
  );
}

interface DrawnProps {
  diagram: Diagram; layer: number; jobs: { a: Job | null; b: Job | null }; app: App;
  /** True if a previous diagram stays, although the arms already execute other jobs. */
  is_kept: boolean;
}

function Drawn({ diagram, layer: index, jobs, is_kept, app }: DrawnProps) {
  const { store } = app;
  const shown_s = app.router.address.value.t_s;
  const layer = diagram.layers[index] ?? diagram.layers[0];
  const host = useRef<HTMLDivElement>(null);
  const scene = useRef<() => Scene | null>(() => null);
  const pointed = useRef<Point | null>(null);
  const picture_shown = useRef<DiagramPicture | null>(null);
  const point_at = (place: Point | null) => {
    pointed.current = place;
    show_both(place, jobs, app);
    picture_shown.current?.draw();
  };
  useEffect(() => () => { app.ghost.value = null; }, [app]);
  const measured = () => measured_path(store.courses.of(diagram.a.id), store.courses.of(diagram.b.id), shown_s ?? Infinity);
  const now_point = () => ({ a_s: progress_of(diagram.a, store, shown_s), b_s: progress_of(diagram.b, store, shown_s) });
  // The page keeps no predictions of the past.
  const plans = is_open(jobs, store) && shown_s === null && !is_kept;
  const authority = () => (shown_s === null && !is_kept ? authority_of(store, diagram) : null);
  const latest = use_latest(diagram, plans, app.api);
  const ahead = (at: Point) => (plans ? ahead_of(latest.layers[index]?.first_contact ?? null, at, authority(), diagram) : null);
  const evidence = evidence_of(jobs.a, jobs.b);
  const names = [...store.arms.keys()];
  scene.current = () => {
    if (!layer) return null;
    const at = now_point();
    const lies = ahead(at);
    const path = measured();
    return {
      authority: authority(), pointed: pointed.current,
      diagram, layer, now: at, prediction: plans ? plan_from(at, diagram) : [], trail: path.length === 0 ? [] : [...path, at] /* the trail ends at the current progress, which is later than the last sample */, contact: lies && 'contact' in lies ? lies.contact : null, evidence,
      colors: { a: ink(arm_color(names, layer.arms[0])), b: ink(arm_color(names, layer.arms[1])) },
    };
  };
  useEffect(() => {
    if (!host.current) return;
    const picture = new DiagramPicture(host.current, () => scene.current());
    picture_shown.current = picture;
    const off = [store.on_beat(() => picture.draw()), store.on_change(() => picture.draw())];
    return () => {
      for (const f of off) f();
      picture.close();
    };
  }, [store, diagram, index, app.settings.shown_theme.value]);
  if (!layer) return null;
  const lies = ahead(now_point());
  const is_measured = measured().length > 1;
  const unheard = !is_measured && [jobs.a, jobs.b].every((job) => job?.started_s != null);
  return (
    <>
      <div ref={host} class="diagram" data-test="diagram" role="img"
        onPointerMove={(event) => {
          const { left, top } = event.currentTarget.getBoundingClientRect();
          point_at(picture_shown.current?.at(event.clientX - left, event.clientY - top) ?? null);
        }}
        onPointerLeave={() => point_at(null)}
        aria-label={kWords.label(diagram.a.id, diagram.b.id)} />
      <Legend layer={layer} of_now={shown_s === null} is_measured={is_measured} />
      {unheard && <p class="hint" data-test="unmeasured">{kWords.unmeasured}</p>}
      <Instant diagram={diagram} jobs={jobs} app={app} show={point_at} />
      {shares(layer).free === 1 && <p class="hint" data-test="all-free">{kWords.all_free}</p>}
      {evidence && <p class="words" data-test="evidence">{evidence_in_words(evidence, diagram)}</p>}
      {lies && <PlanWords ahead={lies} jobs={[jobs.a, jobs.b]} store={store} />}
      <p class="hint explains">
        {kWords.explanation(layer.cells?.length ?? 0, layer.arms[0], layer.arms[1], diagram.evaluations)}
      </p>
    </>
  );
}

/**
 * Returns the progress in trajectory seconds: from the last frame, else from the last event,
 * extrapolated to now.
 */
function progress_of(side: Diagram['a'], store: Store, shown_s: number | null): number {
  const measured_s = shown_s === null ? motion_of(store, side)?.progress_s : measured_at(store, side, shown_s);
  if (measured_s != null) return Math.min(measured_s, side.duration_s);
  const job = store.job(side.id);
  return job ? store.progress(job) * side.duration_s : shown_s === null ? side.progress_s : 0;
}

/**
 * Returns true if a prediction exists: at least one job is unfinished, and no job has ended without
 * success.
 */
function is_open({ a, b }: DrawnProps['jobs'], store: Store): boolean {
  const both = [a, b];
  return both.every((job) => job !== null && (!store.is_terminal(job) || job.state === 'succeeded')) && both.some((job) => job !== null && !store.is_terminal(job));
}

function PlanWords({ ahead, jobs, store }: { ahead: Ahead; jobs: readonly (Job | null)[]; store: Store }) {
  const waiting = jobs.find((job) => job !== null && job.started_s === null && !store.is_terminal(job));
  const resting = jobs.find((job) => job?.state === 'succeeded');
  const { tone, words } = plan_in_words(ahead, waiting?.id ?? null, resting?.id ?? null);
  return <p class={`plan-words ${tone}`} data-test="plan">{words}</p>;
}

/** Shows both arms as ghosts, each at its job's time at the pointed place. */
function show_both(place: Point | null, { a, b }: DrawnProps['jobs'], { motions, ghost }: App): void {
  if (!place || !a || !b) {
    ghost.value = null;
    return;
  }
  ghost.value = { ...motions.of(a)?.q_at(place.a_s), ...motions.of(b)?.q_at(place.b_s) };
}

/** Selects these times without a mouse: one slider for each job. */
function Instant({ diagram, jobs, app, show }: { diagram: Diagram; jobs: DrawnProps['jobs']; app: App; show(place: Point): void }) {
  const [place, set_place] = useState<Point>({ a_s: 0, b_s: 0 });
  app.motions.changes.value;
  const known = [jobs.a, jobs.b].every((job) => job !== null && app.motions.of(job) !== null);
  if (!known) return <p class="hint">{kWords.no_trajectories}</p>;
  const bar = (key: 'a_s' | 'b_s', { id, duration_s }: Diagram['a']) => (
    <label class="line small"><span class="ellipsis">{short_id(id)}</span>
      <input class="grow" type="range" min={0} max={duration_s} step={0.01} value={place[key]} data-test={`instant-${key}`} aria-valuetext={`${place[key].toFixed(2)} s`}
        onInput={(event) => {
          const next = { ...place, [key]: Number(event.currentTarget.value) };
          set_place(next);
          show(next);
        }} />
      <span class="mono">{place[key].toFixed(2)} s</span>
    </label>
  );
  return (
    <fieldset class="pair instants" aria-label={kWords.ghosts_label}><span class="small dim" title={kWords.ghosts_label}>{kWords.ghosts_at}</span>{bar('a_s', diagram.a)}{bar('b_s', diagram.b)}</fieldset>
  );
}

function motion_of(store: Store, { id }: Diagram['a']): ArmAuthority | null {
  return store.motions.find((one) => one.job === id) ?? null;
}

function measured_at(store: Store, { id }: Diagram['a'], t_s: number): number | null {
  const course = store.courses.of(id);
  return course && progress_at(course, t_s);
}

function authority_of(store: Store, { a, b }: Diagram): Point | null {
  const [of_a, of_b] = [motion_of(store, a), motion_of(store, b)];
  if (!of_a && !of_b) return null;
  return { a_s: of_a?.authority_s ?? a.progress_s, b_s: of_b?.authority_s ?? b.progress_s };
}
