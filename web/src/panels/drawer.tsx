// The drawer over the 3D view: a new job to send, or a job's details.

import { useEffect, useState } from 'preact/hooks';
import { example_job, pretty } from '../example';
import type { Problem } from '../messages';
import type { Store } from '../store';
import { clock, reason_in_words, result_in_words, short_id, why_mute } from '../wording';
import type { Actions } from './actions';
import { DiagramPanel, partner_of } from './diagram';
import { Refused } from './refused';
import { use_store } from './use_store';

interface Props { store: Store; actions: Actions }

export function DrawerPanel({ store, actions }: Props) {
  const drawer = actions.drawer.value;
  useEffect(() => {
    const close_on_escape = (event: KeyboardEvent) => {
      if (event.key === 'Escape') actions.drawer.value = { show: 'nothing' };
    };
    window.addEventListener('keydown', close_on_escape);
    return () => window.removeEventListener('keydown', close_on_escape);
  }, [actions]);
  if (drawer.show === 'nothing') return null;
  return (
    <aside class={`drawer${drawer.show === 'diagram' ? ' wide' : ''}`}>
      <button class="close" aria-label="Close" onClick={() => { actions.drawer.value = { show: 'nothing' }; }}>×</button>
      {drawer.show === 'new' && <NewJob store={store} actions={actions} />}
      {drawer.show === 'job' && <JobDetail id={drawer.id} store={store} actions={actions} />}
      {drawer.show === 'diagram' && <DiagramPanel a={drawer.a} b={drawer.b} store={store} actions={actions} />}
    </aside>
  );
}

// What was typed outlives the drawer.
let draft = '';

type Outcome = { kind: 'none' } | { kind: 'sending' } | { kind: 'accepted'; id: string | null } | { kind: 'refused'; problem: Problem };

function NewJob({ store, actions }: Props) {
  use_store(store);
  const [text, set_text] = useState(draft);
  const [outcome, set_outcome] = useState<Outcome>({ kind: 'none' });
  const change = (next: string) => {
    draft = next;
    set_text(next);
    set_outcome({ kind: 'none' });
  };
  const idle = [...store.arms.values()].filter((arm) => arm.state === 'idle' && arm.job === null);
  const mute = why_mute(store.link);
  const send = async () => {
    if (mute !== null) return;
    set_outcome({ kind: 'sending' });
    const answer = await actions.api.post_job(text);
    set_outcome(answer.ok ? { kind: 'accepted', id: id_of(answer.value) } : { kind: 'refused', problem: answer.problem });
  };
  return (
    <>
      <h2>New job</h2>
      <p class="hint">
        A JSON body as for <code>POST /api/v1/jobs</code>; the trajectory has the shape of
        a <code>trajectory_msgs/JointTrajectory</code>.
      </p>
      <div class="line">
        <span class="dim">Example for</span>
        {idle.map((arm) => (
          <button key={arm.name} class="small" data-test={`example-${arm.name}`}
            onClick={() => change(pretty(example_job(arm, store.q_of(arm), store.cell?.joints ?? [])))}>
            {arm.name}
          </button>
        ))}
        {idle.length === 0 && <span class="dim">an idle arm: none at the moment</span>}
      </div>
      <textarea class="mono" spellcheck={false} aria-label="Job as JSON" data-test="job-text" value={text}
        placeholder={'{\n  "trajectory": {\n    "joint_names": […],\n    "points": […]\n  }\n}'}
        onInput={(event) => change(event.currentTarget.value)}
        onKeyDown={(event) => { if (event.key === 'Enter' && (event.ctrlKey || event.metaKey)) void send(); }} />
      <div class="line">
        <span class="grow dim small">Ctrl + Enter sends</span>
        <button class="primary" data-test="send" title={mute ?? ''} onClick={() => void send()}
          disabled={text.trim() === '' || outcome.kind === 'sending' || mute !== null}>
          {outcome.kind === 'sending' ? 'Sending…' : 'Send'}
        </button>
      </div>
      {outcome.kind === 'accepted' && (
        <p class="accepted" role="status" data-test="accepted">
          Accepted{outcome.id === null ? '.' : <>{' as '}<button class="link" onClick={() => { actions.drawer.value = { show: 'job', id: outcome.id ?? '' }; }}>{outcome.id}</button></>}
        </p>
      )}
      {outcome.kind === 'refused' && <Refused problem={outcome.problem} />}
    </>
  );
}

function JobDetail({ id, store, actions }: Props & { id: string }) {
  use_store(store);
  const job = store.job(id);
  const goes_on = job !== null && !store.is_terminal(job);
  useEffect(() => (goes_on ? actions.follow_job(id) : undefined), [actions, id, goes_on]);
  if (!job) return <><h2>{id}</h2><p class="hint">This job is no longer known to the page.</p></>;
  const times: [string, number | null][] = [['submitted', job.submitted_s], ['started', job.started_s], ['ended', job.ended_s]];
  const words = job.result ? result_in_words(job) : reason_in_words(job);
  const partner = partner_of(job, store);
  return (
    <>
      <h2 class="ellipsis">{job.name || job.id}</h2>
      <p class="hint"><span class="mono">{job.id}</span> · {job.arms.join(' + ')} · {job.state}</p>
      {words !== '' && <p class="words">{words}</p>}
      <dl class="facts">
        {times.map(([name, t_s]) => <div key={name}><dt>{name}</dt><dd class="mono">{t_s === null ? '–' : clock(t_s)}</dd></div>)}
        <div><dt>duration</dt><dd class="mono">{job.duration_s.toFixed(2)} s</dd></div>
      </dl>
      {partner && (
        <div class="line">
          <button class="small" data-test="show-diagram" onClick={() => { actions.drawer.value = { show: 'diagram', a: partner.id, b: job.id }; }}>
            Diagram beside {short_id(partner.id)}
          </button>
        </div>
      )}
      <pre class="mono" data-test="raw">{pretty(job)}</pre>
    </>
  );
}

function id_of(value: unknown): string | null {
  const id = (value as { id?: unknown } | null)?.id;
  return typeof id === 'string' ? id : null;
}
