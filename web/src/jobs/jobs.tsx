// The job lists at the side of the page. One filter applies to all of them.

import { useRef, useState } from 'preact/hooks';
import type { Job } from '../server/messages';
import type { App } from '../state/app';
import { instant_of } from '../state/instant';
import type { JobList } from '../state/job_book';
import { is_known } from '../state/as_of';
import { clock } from '../wording';
import { matches } from './filter';
import { frozen_lists, type Lists } from './frozen_lists';
import { Row } from './row';
import { Link } from '../route/link';
import { kText } from '../strings';

const kWords = kText.jobs;

const kShown = 40;

interface Section { list: JobList; title: string; if_empty: string; hint: string }

const kSections: readonly Section[] = [
  { list: 'running', ...kWords.running },
  { list: 'backlog', ...kWords.blocked },
  { list: 'scheduled', ...kWords.scheduled },
  { list: 'queued', ...kWords.queued },
  { list: 'finished', ...kWords.finished },
];

const kLists = kSections.map(({ list }) => list);

/** Returns the job whose row contains the element. */
function row_of(target: EventTarget | null): string | null {
  return target instanceof Element ? target.closest('.job')?.getAttribute('data-test')?.replace(/^job-/, '') ?? null : null;
}

export function Jobs({ app }: { app: App }) {
  const [words, set_words] = useState('');
  const [only_failed, set_only_failed] = useState(false);
  const [pointed_at, set_pointed_at] = useState<string | null>(null);
  const { store } = app;
  const shown = useRef<{ of: unknown; lists: Lists }>({ of: store, lists: new Map() });
  const now = new Map(kLists.map((list) => [list, store.jobs(list)]));
  const lists = shown.current.of === store ? frozen_lists(kLists, now, shown.current.lists, pointed_at) : now;
  shown.current = { of: store, lists };
  const is_asked = (job: Job) => matches(job, words, only_failed);
  return (
    <section class="jobs" aria-label={kWords.title}
      onPointerOver={(event) => set_pointed_at(row_of(event.target))} onPointerLeave={() => set_pointed_at(null)}
      onFocusIn={(event) => { if (event.target instanceof HTMLButtonElement) set_pointed_at(row_of(event.target)); }} onFocusOut={() => set_pointed_at(null)}>
      <div class="filter">
        <input type="search" placeholder={kWords.filter_hint} aria-label={kWords.filter_label} data-test="filter" value={words}
          onInput={(event) => set_words(event.currentTarget.value)} />
        <button class="small" aria-pressed={only_failed} data-test="only-failed" title={kWords.failed_title} onClick={() => set_only_failed(!only_failed)}>{kWords.failed}</button>
      </div>
      <LookedAt app={app} />
      {is_known(app.store) && kSections.map((section) => <List key={section.list} section={section} all={lists.get(section.list) ?? []} app={app} is_asked={is_asked} filtered={words !== '' || only_failed} />)}
    </section>
  );
}

/** States the time that the lists show, if it is not now. */
function LookedAt({ app }: { app: App }) {
  const { t_s } = app.router.address.value;
  if (t_s === null || instant_of(app.router.address.value, app.store).kind === 'now') return null;
  return (
    <p class="hint looked-at" role="status" data-test="state-at">
      {is_known(app.store) ? kWords.state_at(clock(t_s)) : kWords.unknown_at(clock(t_s))}
    </p>
  );
}

/** If the list of ended jobs is not complete for the session, states since when it is complete. */
function EndedFrom({ app }: { app: App }) {
  const { ended_from_s } = app.store.book;
  if (ended_from_s === null) return null;
  return (
    <p class="none" data-test="ended-from">
      {kWords.ended_since(clock(ended_from_s))}<Link app={app} to={{ page: 'history' }}>{kText.page.history}</Link>.
    </p>
  );
}

interface ListProps { section: Section; all: readonly Job[]; app: App; filtered: boolean; is_asked(job: Job): boolean }

function List({ section: { list, title, if_empty, hint }, all, app, filtered, is_asked }: ListProps) {
  const [shown, set_shown] = useState(kShown);
  const jobs = filtered ? all.filter(is_asked) : all;
  if (jobs.length === 0 && (filtered || if_empty === '')) return null;
  const count = filtered ? kWords.of(jobs.length, all.length) : String(all.length);
  return (
    <section data-test={`list-${list}`} class={`list ${list}`} aria-label={title}>
      <h3 title={hint}>{title}<span class="count" data-test={`count-${list}`}>{count}</span></h3>
      {list === 'finished' && <EndedFrom app={app} />}
      {jobs.length === 0 && <p class="none">{if_empty}</p>}
      {jobs.slice(0, shown).map((job) => <Row key={job.id} job={job} app={app} />)}
      {jobs.length > shown && (
        <button class="more" onClick={() => set_shown(shown + 5 * kShown)}>{kText.common.more(jobs.length - shown)}</button>
      )}
    </section>
  );
}
