// Scrolls the answer of a form into view whenever the answer changes, because it often appears
// below the visible part of the page.

import type { ComponentChildren } from 'preact';
import { useLayoutEffect, useRef } from 'preact/hooks';

/** `answer` is null while the form has no answer. */
export function InSight({ answer, children }: { answer: unknown; children: ComponentChildren }) {
  const place = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => { if (answer !== null) place.current?.scrollIntoView({ block: 'nearest' }); }, [answer]);
  return <div class="in-sight" ref={place}>{children}</div>;
}
