// The four lists of jobs: running, queue, backlog with the reason each one waits, finished.

import type { Job } from '../messages';
import { arm_colour } from '../palette';
import type { JobList, Store } from '../store';
import { figure_in_words, reason_in_words, result_in_words, short_id, why_mute } from '../wording';
import type { Actions } from './actions';
import { Bar } from './arms';
import { use_store } from './use_store';

const kShownFinished = 60;

interface Props { store: Store; actions: Actions }

export function Jobs({ store, actions }: Props) {
  use_store(store, 'live');
  const scheduled = store.jobs('scheduled');
  return (
    <div class="jobs">
      <List title="Running" list="running" none="Nothing is moving." store={store} actions={actions} />
      {scheduled.length > 0 && <List title="Scheduled" list="scheduled" none="" store={store} actions={actions} />}
      <List title="Queue" list="queued" none="Empty." store={store} actions={actions} />
      <List title="Backlog" list="backlog" none="No job waits for another." store={store} actions={actions} />
      <List title="Finished" list="finished" none="None yet." store={store} actions={actions} />
    </div>
  );
}

function List({ title, list, none, store, actions }: Props & { title: string; list: JobList; none: string }) {
  const jobs = store.jobs(list);
  return (
    <section data-test={`list-${list}`}>
      <h2>{title}<span class="count">{jobs.length}</span></h2>
      {jobs.length === 0 && <p class="none">{none}</p>}
      {jobs.slice(0, list === 'finished' ? kShownFinished : jobs.length).map((job) => (
        <Row key={job.id} job={job} store={store} actions={actions} />
      ))}
    </section>
  );
}

function Row({ job, store, actions }: Props & { job: Job }) {
  const drawer = actions.drawer.value;
  const selected = (drawer.show === 'job' && drawer.id === job.id) || (drawer.show === 'diagram' && drawer.b === job.id);
  const open = () => { actions.drawer.value = drawer.show === 'job' && selected ? { show: 'nothing' } : { show: 'job', id: job.id }; };
  const blocker = job.waits_on.find((wait) => wait.kind === 'job' && wait.id !== null)?.id ?? null;
  const all_arms = [...store.arms.keys()];
  const ended = store.is_terminal(job);
  const mute = why_mute(store.link);
  return (
    <article
      class={`job ${job.state}${selected ? ' selected' : ''}`} data-test={`job-${job.id}`} data-state={job.state}
      style={{ '--arm': arm_colour(all_arms, job.arms[0] ?? '') }}
    >
      <button class="open" onClick={open} title={`Details of ${job.id}`}>
        <span class="line">
          {job.arms.map((arm) => <span key={arm} class="tag" style={{ '--arm': arm_colour(all_arms, arm) }}>{arm}</span>)}
          <span class="ellipsis">{job.name || short_id(job.id)}</span>
          {job.name !== '' && <span class="id ellipsis">{short_id(job.id)}</span>}
          <span class="grow" />
          <Figure job={job} store={store} />
        </span>
        {blocker === null && <Words job={job} />}
        {(job.state === 'running' || job.state === 'holding') && <Bar share={store.progress(job)} />}
      </button>
      {blocker !== null && (
        <button class="why" data-test="why" title={`Show where ${job.id} and ${blocker} conflict`}
          onClick={() => { actions.drawer.value = { show: 'diagram', a: blocker, b: job.id }; }}>
          <Words job={job} />
        </button>
      )}
      {!ended && (
        <button class="cancel" disabled={job.stopping || mute !== null} title={mute ?? `Cancel ${job.id}`} aria-label={`Cancel ${job.id}`}
          onClick={() => void actions.cancel(job.id)}>
          ×
        </button>
      )}
    </article>
  );
}

function Figure({ job, store }: { job: Job; store: Store }) {
  const { text, title } = figure_in_words(job, store.t_s, store.progress(job));
  return (
    <>
      {store.is_terminal(job) && <span class="verdict">{job.state}</span>}
      <span class="figure" title={title} data-test="figure">{text}</span>
    </>
  );
}

function Words({ job }: { job: Job }) {
  const words = job.result ? result_in_words(job) : reason_in_words(job);
  return words === '' ? null : <span class="words" data-test="reason">{words}</span>;
}
