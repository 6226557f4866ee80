// The side: what moves, what is planned, what is blocked and why, what merely waits its turn, and what
// has ended. A filter goes over all of them.

import { useRef, useState } from 'preact/hooks';
import type { Job } from '../server/messages';
import type { App } from '../state/app';
import { instant_of } from '../state/instant';
import type { JobList } from '../state/job_book';
import { is_known } from '../state/as_of';
import { clock } from '../wording';
import { matches } from './filter';
import { held_lists, type Lists } from './held';
import { Row } from './row';
import { Link } from '../route/link';

const kShown = 40;

interface Section { list: JobList; title: string; none: string; hint: string }

const kSections: readonly Section[] = [
  { list: 'running', title: 'Running', none: 'Nothing is moving.', hint: 'Has authority to move, or stands on its path' },
  { list: 'backlog', title: 'Blocked', none: 'No job is blocked.', hint: 'In the backlog: each was tried and is in conflict; it is tried again until it expires' },
  { list: 'scheduled', title: 'Scheduled', none: '', hint: 'Admitted: it is decided who passes first' },
  { list: 'queued', title: 'Queued', none: 'No job is queued.', hint: 'Not tried yet: others come first' },
  { list: 'finished', title: 'Finished', none: 'No job has ended in this run of the server.', hint: 'In this run of the server, newest first' },
];

const kLists = kSections.map(({ list }) => list);

/** The job whose row something is in. */
function row_of(target: EventTarget | null): string | null {
  return target instanceof Element ? target.closest('.job')?.getAttribute('data-test')?.replace(/^job-/, '') ?? null : null;
}

export function Jobs({ app }: { app: App }) {
  const [words, set_words] = useState('');
  const [only_failed, set_only_failed] = useState(false);
  const [held, set_held] = useState<string | null>(null);
  const { store } = app;
  const shown = useRef<{ of: unknown; lists: Lists }>({ of: store, lists: new Map() });
  const now = new Map(kLists.map((list) => [list, store.jobs(list)]));
  const lists = shown.current.of === store ? held_lists(kLists, now, shown.current.lists, held) : now;
  shown.current = { of: store, lists };
  const is_asked = (job: Job) => matches(job, words, only_failed);
  return (
    <section class="jobs" aria-label="Jobs"
      onPointerOver={(event) => set_held(row_of(event.target))} onPointerLeave={() => set_held(null)}
      onFocusIn={(event) => { if (event.target instanceof HTMLButtonElement) set_held(row_of(event.target)); }} onFocusOut={() => set_held(null)}>
      <div class="filter">
        <input type="search" placeholder="Filter: id, name, arm, state" aria-label="Filter jobs" data-test="filter" value={words}
          onInput={(event) => set_words(event.currentTarget.value)} />
        <button class="small" aria-pressed={only_failed} data-test="only-failed" title="Only jobs that did not succeed" onClick={() => set_only_failed(!only_failed)}>Failed</button>
      </div>
      <LookedAt app={app} />
      {is_known(app.store) && kSections.map((section) => <List key={section.list} section={section} all={lists.get(section.list) ?? []} app={app} is_asked={is_asked} filtered={words !== '' || only_failed} />)}
    </section>
  );
}

/** Which time these lists are of, where it is not now. */
function LookedAt({ app }: { app: App }) {
  const { t_s } = app.router.address.value;
  if (t_s === null || instant_of(app.router.address.value, app.store).kind === 'now') return null;
  return (
    <p class="hint looked-at" role="status" data-test="looked-at">
      {is_known(app.store) ? `As it was at ${clock(t_s)}.` : `Which jobs there were at ${clock(t_s)} is not known here.`}
    </p>
  );
}

/** Since when those that have ended are all there, where not all of the run are. */
function EndedFrom({ app }: { app: App }) {
  const { ended_from_s } = app.store.book;
  if (ended_from_s === null) return null;
  return (
    <p class="none" data-test="ended-from">
      Since {clock(ended_from_s)}; earlier ones are not loaded: see <Link app={app} to={{ page: 'history' }}>History</Link>.
    </p>
  );
}

interface ListProps { section: Section; all: readonly Job[]; app: App; filtered: boolean; is_asked(job: Job): boolean }

function List({ section: { list, title, none, hint }, all, app, filtered, is_asked }: ListProps) {
  const [shown, set_shown] = useState(kShown);
  const jobs = filtered ? all.filter(is_asked) : all;
  if (jobs.length === 0 && (filtered || none === '')) return null;
  const count = filtered ? `${jobs.length} of ${all.length}` : String(all.length);
  return (
    <section data-test={`list-${list}`} class={`list ${list}`} aria-label={title}>
      <h3 title={hint}>{title}<span class="count" data-test={`count-${list}`}>{count}</span></h3>
      {list === 'finished' && <EndedFrom app={app} />}
      {jobs.length === 0 && <p class="none">{none}</p>}
      {jobs.slice(0, shown).map((job) => <Row key={job.id} job={job} app={app} />)}
      {jobs.length > shown && (
        <button class="more" onClick={() => set_shown(shown + 5 * kShown)}>{jobs.length - shown} more</button>
      )}
    </section>
  );
}
