// The coordination diagram of two jobs: which pairs of progress are free, which are in conflict, where
// both are now, and where they would go from here.

import { useEffect, useRef, useState } from 'preact/hooks';
import {
  evidence_in_words, evidence_of, plan_from, plan_in_words, shares, type Point,
} from './reading';
import type { Diagram, Job, Problem } from '../server/messages';
import { arm_colour, ink, kCellColours } from '../state/palette';
import type { Store } from '../state/store';
import { short_id } from '../wording';
import type { Api } from '../server/api';
import type { App } from '../state/app';
import { DiagramPicture, type Scene } from './picture';
import { Refused } from '../compose/refused';
import { use_store } from '../state/use_store';

const kShownFinished = 12;
const kTrail = 2000;
const kAheadEvery_ms = 500;

interface Props { a: string; b: string; app: App }

type Fetched = { kind: 'none' } | { kind: 'diagram'; diagram: Diagram } | { kind: 'refused'; problem: Problem };

export function DiagramPanel({ a, b, app }: Props) {
  const { store, actions, api } = app;
  use_store(store, 'live');
  const [fetched, set_fetched] = useState<Fetched>({ kind: 'none' });
  const [layer, set_layer] = useState(0);
  const connected = store.link.status === 'open';
  // Another scene makes another diagram.
  useEffect(() => {
    if (!connected) return;
    let closed = false;
    void api.diagram(a, b).then((answer) => {
      if (closed) return;
      set_fetched(answer.ok ? { kind: 'diagram', diagram: answer.value } : { kind: 'refused', problem: answer.problem });
    });
    return () => { closed = true; };
  }, [api, a, b, store.objects, connected]);
  useEffect(() => set_layer(0), [a, b]);
  const jobs = { a: store.job(a), b: store.job(b) };
  const goes_on = { a: jobs.a !== null && !store.is_terminal(jobs.a), b: jobs.b !== null && !store.is_terminal(jobs.b) };
  useEffect(() => (goes_on.a ? actions.follow_job(a) : undefined), [actions, a, goes_on.a]);
  useEffect(() => (goes_on.b ? actions.follow_job(b) : undefined), [actions, b, goes_on.b]);
  const diagram = fetched.kind === 'diagram' && fetched.diagram.a.id === a && fetched.diagram.b.id === b ? fetched.diagram : null;
  return (
    <>
      <h2>Diagram</h2>
      <div class="pair">
        <Pick what="Across" id={a} store={store} on_pick={(id) => app.router.go({ page: 'pair', a: id, b })} />
        <Pick what="Up" id={b} store={store} on_pick={(id) => app.router.go({ page: 'pair', a, b: id })} />
      </div>
      {fetched.kind === 'refused' && <Refused problem={fetched.problem} />}
      {diagram && diagram.layers.length > 1 && (
        <div class="line">
          {diagram.layers.map(({ arms }, i) => (
            <button key={i} class="small" aria-pressed={i === layer} onClick={() => set_layer(i)}>{arms.join(' – ')}</button>
          ))}
        </div>
      )}
      {diagram && <Drawn key={`${a} ${b} ${layer}`} diagram={diagram} layer={layer} jobs={jobs} app={app} />}
      {fetched.kind !== 'refused' && !diagram && <p class="hint">{connected ? 'Drawing…' : 'Not connected.'}</p>}
    </>
  );
}

function Pick({ what, id, store, on_pick }: { what: string; id: string; store: Store; on_pick(id: string): void }) {
  const jobs = store.all_jobs().filter((job) => !store.is_terminal(job)).concat(store.jobs('finished').slice(0, kShownFinished));
  const chosen = store.job(id);
  if (!jobs.some((job) => job.id === id)) { if (chosen) jobs.push(chosen); }
  const names = [...store.arms.keys()];
  return (
    <label class="pick" style={{ '--arm': arm_colour(names, chosen?.arms[0] ?? '') }}>
      <span class="small dim">{what}</span>
      <span class="swatch" />
      <select value={id} aria-label={`Job ${what.toLowerCase()}`} onChange={(event) => on_pick(event.currentTarget.value)}>
        {!chosen && <option value={id}>{id}</option>}
        {jobs.map((job) => <option key={job.id} value={job.id}>{`${short_id(job.id)} (${job.arms.join(' + ')}, ${job.state})`}</option>)}
      </select>
    </label>
  );
}

/** The diagram as the server answers it again and again, without its cells: what lies ahead by now. */
function use_ahead(diagram: Diagram, is_open: boolean, api: Api): Diagram {
  const [ahead, set_ahead] = useState(diagram);
  useEffect(() => {
    set_ahead(diagram);
    if (!is_open) return;
    let closed = false;
    const ask = async () => {
      const answer = await api.diagram(diagram.a.id, diagram.b.id, false);
      if (closed) return;
      if (answer.ok) set_ahead(answer.value);
      timer = setTimeout(() => void ask(), kAheadEvery_ms);
    };
    let timer = setTimeout(() => void ask(), kAheadEvery_ms);
    return () => {
      closed = true;
      clearTimeout(timer);
    };
  }, [api, diagram, is_open]);
  return ahead;
}

interface DrawnProps {
  diagram: Diagram; layer: number; jobs: { a: Job | null; b: Job | null }; app: App;
}

function Drawn({ diagram, layer: index, jobs, app }: DrawnProps) {
  const { store } = app;
  const layer = diagram.layers[index] ?? diagram.layers[0];
  const host = useRef<HTMLDivElement>(null);
  const scene = useRef<() => Scene | null>(() => null);
  const trail = useRef<Point[]>([]);
  // Where they are by the last answer and event, carried on with the clock.
  const progress_s = (side: Diagram['a']) => {
    const job = store.job(side.id);
    return job ? store.progress(job) * side.duration_s : side.progress_s;
  };
  const now_point = () => ({ a_s: progress_s(diagram.a), b_s: progress_s(diagram.b) });
  const is_open = [jobs.a, jobs.b].every((job) => job !== null && (!store.is_terminal(job) || job.state === 'succeeded'))
    && [jobs.a, jobs.b].some((job) => job !== null && !store.is_terminal(job));
  const ahead = use_ahead(diagram, is_open, app.api);
  const met = is_open ? ahead.layers[index]?.met ?? null : null;
  const evidence = evidence_of(jobs.a, jobs.b);
  const names = [...store.arms.keys()];
  scene.current = () => {
    if (!layer) return null;
    const at = now_point();
    const last = trail.current.at(-1);
    if (!last || last.a_s !== at.a_s || last.b_s !== at.b_s) trail.current = [...trail.current.slice(1 - kTrail), at];
    return {
      diagram, layer, now: at, way: is_open ? plan_from(at, diagram) : [], trail: trail.current, met, evidence,
      colours: { a: ink(arm_colour(names, layer.arms[0])), b: ink(arm_colour(names, layer.arms[1])) },
    };
  };
  useEffect(() => {
    if (!host.current) return;
    const picture = new DiagramPicture(host.current, () => scene.current());
    const off = [store.on_beat(() => picture.draw()), store.on_change(() => picture.draw())];
    return () => {
      for (const f of off) f();
      picture.close();
    };
  }, [store, diagram, index, app.settings.shown_theme.value]);
  if (!layer) return null;
  const share = shares(layer);
  const waiting = [jobs.a, jobs.b].find((job) => job !== null && job.started_s === null && !store.is_terminal(job)) ?? null;
  const resting = [jobs.a, jobs.b].find((job) => job?.state === 'succeeded') ?? null;
  return (
    <>
      <div ref={host} class="diagram" data-test="diagram" role="img"
        aria-label={`Where ${diagram.a.id} (across) and ${diagram.b.id} (up) are in conflict`} />
      <div class="line keys">
        {(['free', 'conflict', 'undecided'] as const).map((state) => (
          <span key={state} class="key"><i style={{ background: kCellColours[state] }} /> {state} <b class="mono">{percent(share[state])}</b></span>
        ))}
        <span class="grow" />
        <span class="key"><i class="plan" /> plan from now</span>
      </div>
      {evidence && <p class="words" data-test="evidence">{evidence_in_words(evidence, diagram)}</p>}
      {is_open && <p class={`plan-words${met ? '' : ' free'}`} data-test="plan">{plan_in_words(met, waiting?.id ?? null, resting?.id ?? null)}</p>}
      <p class="hint">
        Each cell holds for every instant in it, at any pace: {layer.cells?.length ?? 0} cells between
        the {layer.arms[0]} and the {layer.arms[1]} arm, {diagram.evaluations} states looked at.
      </p>
    </>
  );
}

function percent(share: number): string {
  return share > 0 && share < 0.005 ? '< 1 %' : `${(100 * share).toFixed(0)} %`;
}
