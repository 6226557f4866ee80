// A link to a page of the dashboard. It is an HTML link, so that users can copy it or open it in
// another window.

import type { ComponentChildren } from 'preact';
import type { App } from '../state/app';
import type { Place } from './address';

interface Props {
  app: App;
  to: Place;
  class?: string;
  title?: string;
  current?: boolean;
  test?: string;
  label?: string;
  children: ComponentChildren;
}

export function Link({ app, to, class: name = 'link', title, current, test, label, children }: Props) {
  return (
    <a href={app.router.href(to)} class={name} title={title} aria-label={label} aria-current={current ? 'page' : undefined} data-test={test}>
      {children}
    </a>
  );
}
