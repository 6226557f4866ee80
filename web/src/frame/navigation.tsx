// Links to the pages: the most used in the header, the others in the menu More.

import { useEffect, useRef } from 'preact/hooks';
import { Link } from '../route/link';
import type { App } from '../state/app';
import { kText } from '../strings';
import { kPages, type Page } from './pages';

export function Navigation({ app }: { app: App }) {
  return (
    <nav aria-label={kText.frame.pages}>
      {kPages.filter(({ more }) => !more).map((page) => <Tab key={page.title} page={page} app={app} />)}
      <More app={app} />
    </nav>
  );
}

function Tab({ page: { place, title, key, test }, app }: { page: Page; app: App }) {
  const to = place(app);
  return (
    <Link app={app} to={to} class="tab" test={test} current={to.page === app.router.address.value.place.page}
      title={app.settings.letter_keys.value ? kText.frame.page_and_key(title, key) : title}>{title}</Link>
  );
}

/** The menu More. It closes on a choice, on Escape, and on any action outside of it. */
function More({ app }: { app: App }) {
  const menu = useRef<HTMLDetailsElement>(null);
  const pages = kPages.filter(({ more }) => more);
  const here = app.router.address.value.place;
  const current = pages.find((page) => page.place(app).page === here.page);
  const close = () => menu.current?.removeAttribute('open');
  useEffect(close, [here]);
  useEffect(() => {
    const elsewhere = (event: Event) => {
      if (event.target instanceof Node && !menu.current?.contains(event.target)) close();
    };
    for (const what of ['pointerdown', 'focusin']) window.addEventListener(what, elsewhere);
    return () => { for (const what of ['pointerdown', 'focusin']) window.removeEventListener(what, elsewhere); };
  }, []);
  return (
    <details class="more-pages" ref={menu} onKeyDown={(event) => {
      if (event.key !== 'Escape') return;
      close();
      menu.current?.querySelector('summary')?.focus();
    }}>
      <summary class={`tab${current ? ' current' : ''}`} data-test="more-pages" title={kText.frame.more_pages_title}>{current?.title ?? kText.frame.more_pages}<span class="opens" aria-hidden="true">▾</span></summary>
      <div class="more-list" onClick={close}>
        {pages.map((page) => <Tab key={page.title} page={page} app={app} />)}
      </div>
    </details>
  );
}
