// The slider of the speed override, of the cell (`arm` is null) or of one arm. It shows the value
// that the server confirms. Arrow keys change the value by 1 %, Page Up and Page Down by 10 %.

import { useEffect } from 'preact/hooks';
import { shown_name } from '../names';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { kText } from '../strings';

const kWords = kText.speed;

/** Returns a share in percent: "25 %", "0.1 %". */
export function percent_text(share: number): string {
  return `${Number((100 * share).toFixed(share < 0.01 ? 2 : 1))} %`;
}

interface Props { app: App; arm: string | null; told: number; effective?: number | undefined }

export function SpeedSlider({ app, arm, told, effective }: Props) {
  const { speed } = app.actions;
  useEffect(() => speed.confirm(arm, told), [told, arm]);
  const share = speed.shown(arm, told);
  const why_disabled = why_no_command(app);
  const name = arm === null ? kWords.of_cell : kWords.of_arm(shown_name(arm));
  const effect = effective !== undefined && effective !== told && share === told ? kWords.effective(percent_text(effective)) : '';
  return (
    <label class={`speed${share < 1 ? ' slowed' : ''}`} title={why_disabled ?? kWords.title}>
      <span class="speed-name" aria-hidden="true">{arm === null ? kWords.of_cell : kWords.short}</span>
      <input type="range" min={0} max={100} step={1} value={Math.round(100 * share)} disabled={why_disabled !== null}
        aria-label={name} aria-valuetext={percent_text(share)} data-test={arm === null ? 'speed-cell' : `speed-${arm}`}
        onInput={(event) => speed.set(arm, Number(event.currentTarget.value) / 100)} />
      <output class="mono" data-test={arm === null ? 'speed-cell-value' : `speed-${arm}-value`}>{percent_text(share)}{effect}</output>
    </label>
  );
}
