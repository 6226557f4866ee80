// What the colours and strokes of a diagram mean.

import type { DiagramLayer } from '../server/messages';
import { kCellColours, kUndecidedStripes } from '../state/palette';
import { shares } from './reading';

/** `of_now`: it shows what lies ahead, too; `is_measured`: a way that was measured is drawn. */
export function Legend({ layer, of_now, is_measured }: { layer: DiagramLayer; of_now: boolean; is_measured: boolean }) {
  const share = shares(layer);
  return (
    <div class="keys">
      <div class="line">{(['free', 'conflict', 'undecided'] as const).map((state) => (
        <span key={state} class="key"><i class={state} style={{ '--cell': kCellColours[state], '--stripes': kUndecidedStripes }} /> {state} <b class="mono">{percent(share[state])}</b></span>
      ))}</div>
      <div class="line">
        {of_now && <><span class="key" title="How far each may go, whatever the other one does"><i class="authority" /> authority</span>
        <span class="key" title="As it is not going to be where one of them waits"><i class="plan" /> if both go on</span>
        <span class="key" title="Where that would first be in conflict, or where it is not proven free"><i class="met">×</i> not free there</span></>}
        {is_measured && <span class="key" data-test="measured"><i class="measured" /> measured</span>}
      </div>
    </div>
  );
}

function percent(share: number): string {
  return share > 0 && share < 0.005 ? '< 1 %' : `${(100 * share).toFixed(0)} %`;
}
