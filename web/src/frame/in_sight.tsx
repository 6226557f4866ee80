// What a form answers stands below it, and often below what is seen of its page: it is brought into sight, as
// far as it has to be, each time that there is another answer.

import type { ComponentChildren } from 'preact';
import { useLayoutEffect, useRef } from 'preact/hooks';

/** `answer`: null, as long as there is none. */
export function InSight({ answer, children }: { answer: unknown; children: ComponentChildren }) {
  const place = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => { if (answer !== null) place.current?.scrollIntoView({ block: 'nearest' }); }, [answer]);
  return <div class="in-sight" ref={place}>{children}</div>;
}
