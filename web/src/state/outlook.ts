// What of the server's forecast can be known. Pure. The server expects whatever stands for a reason of its
// own to stand for as long again as it has; of an arm that was stopped nobody knows how long that is: it
// stands until somebody resumes it, and what comes after that, or waits for it, has no time.

import type { Forecast, ForecastLeg } from '../server/messages';

type Pause = ForecastLeg['pauses'][number];

export function outlook_of(forecast: Forecast): Forecast {
  const endless = endless_of(forecast);
  if (endless.size === 0) return forecast;
  const arms = forecast.arms.map((lane) => {
    const first = lane.legs.findIndex((leg) => endless.has(leg.id));
    if (first < 0) return lane;
    return { ...lane, legs: lane.legs.map((leg, i) => (i < first ? leg : without_end(leg, i === first, endless))) };
  });
  return { ...forecast, arms };
}

/** Legs that do not end before somebody resumes an arm: stopped ones, those behind them, and those that wait for one of these. */
function endless_of({ arms }: Forecast): Set<string> {
  const endless = new Set<string>();
  const waits = ({ waits_on }: Pause) => waits_on?.kind === 'stop' || (waits_on?.id != null && endless.has(waits_on.id));
  // Each round finds one more at least: there are no more rounds than legs.
  for (let known = -1; known < endless.size;) {
    known = endless.size;
    for (const { legs } of arms) {
      const first = legs.findIndex((leg) => endless.has(leg.id) || leg.pauses.some(waits));
      if (first >= 0) for (const leg of legs.slice(first)) endless.add(leg.id);
    }
  }
  return endless;
}

/** `is_next`: nothing of its arm that has no end is before it. */
function without_end(leg: ForecastLeg, is_next: boolean, endless: ReadonlySet<string>): ForecastLeg {
  const holds = is_next ? leg.pauses.findIndex(({ waits_on }) => waits_on?.kind === 'stop' || (waits_on?.id != null && endless.has(waits_on.id))) : -1;
  const pauses = leg.pauses.slice(0, holds + 1).map((pause, i) => (i === holds ? { ...pause, to_s: null } : pause));
  // One that has begun, or begins before it comes to stand, keeps its beginning.
  const begins = is_next && (leg.progress > 0 || leg.state === 'running' || leg.state === 'holding' || (pauses.at(-1)?.at_s ?? 0) > 0);
  return { ...leg, starts_s: begins ? leg.starts_s : null, ends_s: null, pauses };
}
