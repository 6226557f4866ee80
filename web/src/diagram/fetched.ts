// Fetches diagrams. The complete diagram is fetched when the jobs or the scene change; between
// changes only the prediction is fetched.

import { useEffect, useRef, useState } from 'preact/hooks';
import type { Answer, Api } from '../server/api';
import type { Diagram, Problem } from '../server/messages';
import { OneAtATime } from './one_at_a_time';

const kAheadEvery_ms = 500;

/**
 * `diagram` is the last diagram received; it may be of other jobs than requested. `refused` is the
 * problem if the last request was refused.
 */
export interface Fetched { diagram: Diagram | null; refused: { a: string; b: string; problem: Problem } | null }

/**
 * Fetches the diagram of two jobs. Short jobs change faster than diagrams arrive, so the last
 * diagram stays until the next arrives.
 */
export function use_fetched(api: Pick<Api, 'diagram'>, a: string, b: string, scene: unknown, connected: boolean): Fetched {
  const [fetched, set_fetched] = useState<Fetched>({ diagram: null, refused: null });
  const drawings = useRef<OneAtATime<{ a: string; b: string }, Answer<Diagram>> | null>(null);
  useEffect(() => {
    const asked = new OneAtATime<{ a: string; b: string }, Answer<Diagram>>((pair) => api.diagram(pair.a, pair.b), (answer, pair) => {
      set_fetched(({ diagram }) => (answer.ok ? { diagram: answer.value, refused: null } : { diagram, refused: { ...pair, problem: answer.problem } }));
    });
    drawings.current = asked;
    return () => asked.close();
  }, [api]);
  // A change of the scene requires a new diagram.
  useEffect(() => { if (connected) drawings.current?.want({ a, b }); }, [api, a, b, scene, connected]);
  return fetched;
}

/** Fetches the diagram without its cells every half second, because only its prediction changes. */
export function use_latest(diagram: Diagram, is_open: boolean, api: Api): Diagram {
  const [latest, set_latest] = useState(diagram);
  useEffect(() => {
    set_latest(diagram);
    if (!is_open) return;
    let closed = false;
    const ask = async () => {
      const answer = await api.diagram(diagram.a.id, diagram.b.id, false);
      if (closed) return;
      if (answer.ok) set_latest(answer.value);
      timer = setTimeout(() => void ask(), kAheadEvery_ms);
    };
    let timer = setTimeout(() => void ask(), kAheadEvery_ms);
    return () => {
      closed = true;
      clearTimeout(timer);
    };
  }, [api, diagram, is_open]);
  return latest;
}
