// The legend of a diagram.

import type { DiagramLayer } from '../server/messages';
import { kCellColors, kUndecidedStripes } from '../state/palette';
import { kText } from '../strings';
import { shares } from './reading';

const kWords = kText.diagram;

/** `of_now` adds the entries of the prediction, `is_measured` the entry of the measured path. */
export function Legend({ layer, of_now, is_measured }: { layer: DiagramLayer; of_now: boolean; is_measured: boolean }) {
  const share = shares(layer);
  return (
    <div class="keys">
      <div class="line">{(['free', 'conflict', 'undecided'] as const).map((state) => (
        <span key={state} class="key"><i class={state} style={{ '--cell': kCellColors[state], '--stripes': kUndecidedStripes }} /> {state} <b class="mono">{percent(share[state])}</b></span>
      ))}</div>
      <div class="line">
        {of_now && <><span class="key" title={kWords.authority_title}><i class="authority" /> {kWords.authority}</span>
        <span class="key" title={kWords.prediction_title}><i class="plan" /> {kWords.prediction}</span>
        <span class="key" title={kWords.contact_title}><i class="met">{kWords.contact_sign}</i> {kWords.contact}</span></>}
        {is_measured && <span class="key" data-test="measured"><i class="measured" /> {kWords.measured}</span>}
      </div>
    </div>
  );
}

function percent(share: number): string {
  return share > 0 && share < 0.005 ? '< 1 %' : `${(100 * share).toFixed(0)} %`;
}
