// The pane: shows the page that the address names, next to the cell or over it.

import type { ComponentChildren, RefObject } from 'preact';
import { useEffect, useLayoutEffect, useRef } from 'preact/hooks';
import { ArmPage } from '../arms/arm_page';
import { AlertsPage } from '../alerts/alerts_page';
import { NewJob } from '../compose/new_job';
import { DiagramPanel } from '../diagram/diagram';
import { IoPage } from '../io/io_page';
import { HistoryPage } from '../history/history_page';
import { place_in_words, type Place } from '../route/address';
import { Link } from '../route/link';
import type { App } from '../state/app';
import { PoliciesPage } from '../policies/policies_page';
import { RecordingsPage } from '../recordings/recordings_page';
import { RecoveryPage } from '../recovery/recovery_page';
import { seen_app } from '../state/as_of';
import { kPages } from './pages';
import { SettingsPage } from './settings_page';
import { shown_text } from '../names';
import { ScenePage } from '../scene/scene_page';
import { JobPage } from '../jobs/job_page';
import { kText } from '../strings';

const kWidths: Partial<Record<Place['page'], string>> = { pair: ' wide', job: ' wide', history: ' full', settings: ' full', policies: ' full' };

export function Pane({ app }: { app: App }) {
  const { place } = app.router.address.value;
  const pane = useRef<HTMLElement>(null);
  const width = kWidths[place.page] ?? '';
  useEffect(() => {
    const tell = () => { app.covered_px.value = pane.current ? pane.current.offsetLeft + pane.current.offsetWidth : 0; };
    tell();
    const observer = new ResizeObserver(tell);
    if (pane.current) observer.observe(pane.current);
    return () => observer.disconnect();
  }, [app, place.page]);
  use_focus(pane, place.page);
  if (place.page === 'cell') return null;
  return (
    <section ref={pane} tabIndex={-1} class={`pane${width}`} aria-label={place_in_words(place)} data-test={`page-${place.page}`}>
      <button class="close" aria-label={kText.frame.close} title={kText.frame.close_title} onClick={() => app.router.go({ page: 'cell' })}>×</button>
      <div class="pane-body" key={JSON.stringify(place)}>{content_of(place, app)}</div>
    </section>
  );
}

/** Moves the focus to a page when it opens, and back when it closes. */
function use_focus(pane: RefObject<HTMLElement>, page: Place['page']): void {
  const before = useRef<Element | null>(null);
  const last = useRef(page);
  useLayoutEffect(() => {
    if (page === last.current) return;
    if (last.current === 'cell') before.current = document.activeElement;
    last.current = page;
    const back = before.current;
    if (page !== 'cell') pane.current?.focus({ preventScroll: true });
    else if (document.activeElement === document.body && back instanceof HTMLElement) back.focus({ preventScroll: true });
  }, [page]);
}

function content_of(place: Place, app: App): ComponentChildren {
  switch (place.page) {
    case 'cell': return null;
    case 'new': return <NewJob app={app} />;
    case 'job': return <JobPage id={place.id} app={seen_app(app)} />;
    case 'arm': return <ArmPage name={place.name} app={app} />;
    case 'pair': return <DiagramPanel a={place.a} b={place.b} app={app} />;
    case 'scene': return <ScenePage name={place.name} app={seen_app(app)} />;
    case 'io': return <IoPage app={seen_app(app)} />;
    case 'history': return <HistoryPage app={seen_app(app)} />;
    case 'alerts': return <AlertsPage app={app} />;
    case 'recovery': return <RecoveryPage app={seen_app(app)} />;
    case 'policies': return <PoliciesPage app={seen_app(app)} />;
    case 'recordings': return <RecordingsPage app={app} />;
    case 'settings': return <SettingsPage app={app} />;
    case 'unknown': return (
      <>
        <h2>{kText.frame.no_page}</h2>
        <p class="hint">{kText.frame.no_page_at(shown_text(place.path))}</p>
        <ul class="plain places">{kPages.map((page) => <li key={page.title}><Link app={app} to={page.place(app)}>{page.title}</Link></li>)}</ul>
      </>
    );
  }
}
