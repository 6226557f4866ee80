// A problem that the server answered: each fault with its JSON pointer and the value found.

import type { Problem } from '../server/messages';
import { found_in_words } from '../wording';

export function Refused({ problem }: { problem: Problem }) {
  const faults: Partial<Problem>[] = problem.errors ?? [problem];
  return (
    <div class="refused" role="alert" data-test="problem">
      <b>{problem.title}{problem.status ? ` (${problem.status})` : ''}</b>
      {faults.map((fault, i) => (
        <div key={i} class="fault">
          {fault.detail && <div>{fault.detail}</div>}
          {fault.pointer && <div class="mono small dim">{fault.pointer}</div>}
          {found_in_words(fault.value) !== '' && <div class="mono small">{found_in_words(fault.value)}</div>}
        </div>
      ))}
    </div>
  );
}
