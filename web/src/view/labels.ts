// A label under each arm: its name and its state, in words, a glyph and a colour.

import type { ArmState } from '../server/messages';
import { arm_colour, kStateColours, kStateGlyphs } from '../state/palette';
import { stacked } from './stacking';
import { shown_name } from '../names';

const kHeight_px = 22;
const kGap_px = 4;

interface Point { x: number; y: number }
interface Label { element: HTMLElement; name: HTMLElement; state: HTMLElement; width_px: number }

export class ArmLabels {
  private readonly labels_ = new Map<string, Label>();
  private lit_: readonly string[] = [];

  constructor(private readonly host_: HTMLElement) {}

  show(arm: string, state: ArmState, arms: readonly string[]): void {
    let label = this.labels_.get(arm);
    if (!label) {
      label = make_label();
      this.labels_.set(arm, label);
      this.host_.append(label.element);
      label.element.classList.toggle('lit', this.lit_.includes(arm));
    }
    label.name.textContent = shown_name(arm);
    const words = `${kStateGlyphs[state]} ${state}`;
    if (label.state.textContent !== words) label.width_px = 0;
    label.state.textContent = words;
    label.element.style.setProperty('--arm', arm_colour(arms, arm));
    label.element.style.setProperty('--state', kStateColours[state]);
  }

  light(arms: readonly string[]): void {
    this.lit_ = arms;
    for (const [name, label] of this.labels_) label.element.classList.toggle('lit', arms.includes(name));
  }

  /** Puts each where the function says, px from the view's top left, or below one that is there; null hides it. */
  place(where: (arm: string) => Point | null): void {
    const found = [...this.labels_].flatMap(([name, label]) => {
      const p = where(name);
      label.element.hidden = p === null;
      return p ? [{ label, p }] : [];
    });
    for (const { label } of found) label.width_px ||= label.element.offsetWidth;
    const y = stacked(found.map(({ label, p }) => ({ ...p, width_px: label.width_px })), kHeight_px, kGap_px);
    found.forEach(({ label, p }, i) => {
      label.element.style.transform = `translate(${p.x.toFixed(1)}px, ${(y[i] ?? p.y).toFixed(1)}px)`;
    });
  }

  clear(): void {
    for (const { element } of this.labels_.values()) element.remove();
    this.labels_.clear();
  }
}

function make_label(): Label {
  const element = document.createElement('div');
  const name = document.createElement('b');
  const state = document.createElement('span');
  element.className = 'arm-label';
  element.append(name, state);
  return { element, name, state, width_px: 0 };
}
