// The predicted timeline as text for screen readers. It is updated once per second.

import { useEffect, useState } from 'preact/hooks';
import type { App } from '../state/app';
import { known_lanes } from './known';
import { lane_in_words } from './mark_words';

const kRenew_ms = 1000;

export function TextList({ app }: { app: App }) {
  const [lanes, set_lanes] = useState<{ arm: string; words: string[] }[]>([]);
  useEffect(() => {
    const renew = () => set_lanes(known_lanes(app).map((lane) => ({ arm: lane.arm, words: lane_in_words(lane, app.store.t_s) })));
    renew();
    const timer = setInterval(renew, kRenew_ms);
    return () => clearInterval(timer);
  }, [app]);
  return (
    <dl class="sr-only" data-test="timeline-text">
      {lanes.map(({ arm, words }) => (
        <div key={arm} data-test={`lane-text-${arm}`}><dt>{arm}</dt>{words.map((word, i) => <dd key={i}>{word}</dd>)}</div>
      ))}
    </dl>
  );
}
