// A label under each arm. It shows the arm's name and its state, in words, glyph and color.

import { arm_color, kStateColors, kStateGlyphs } from '../state/palette';
import { is_alarming, type ShownState } from '../state/shown_state';
import { stacked, within_room } from './stacking';
import { shown_name } from '../names';

const kHeight_px = 22;
const kGap_px = 4;
// The distance from the arm's base to the top of its label.
const kBelow_px = 26;
const kBelowShort_px = 8;
// With more arms than this, labels have no room for words.
const kMostInWords = 4;
// A label that was moved down by more than this would seem to belong to another arm.
const kMostBelow_px = 30;

interface Point { x: number; y: number }
interface Label { element: HTMLElement; name: HTMLElement; glyph: HTMLElement; state: HTMLElement; width_px: number }

export class ArmLabels {
  private readonly labels_ = new Map<string, Label>();
  private lit_: readonly string[] = [];

  constructor(private readonly host_: HTMLElement) {}

  show(arm: string, state: ShownState, arms: readonly string[], words: string): void {
    let label = this.labels_.get(arm);
    if (!label) {
      label = make_label();
      this.labels_.set(arm, label);
      this.host_.append(label.element);
      label.element.classList.toggle('lit', this.lit_.includes(arm));
    }
    label.name.textContent = shown_name(arm);
    if (label.state.textContent !== words) label.width_px = 0;
    label.glyph.textContent = kStateGlyphs[state];
    label.state.textContent = words;
    label.element.classList.toggle('alarmed', is_alarming(state));
    label.element.classList.toggle('short', arms.length > kMostInWords);
    label.element.style.setProperty('--arm', arm_color(arms, arm));
    label.element.style.setProperty('--state', kStateColors[state]);
  }

  light(arms: readonly string[]): void {
    this.lit_ = arms;
    for (const [name, label] of this.labels_) {
      label.element.classList.toggle('lit', arms.includes(name));
      label.width_px = 0;
    }
  }

  /**
   * Places each label at the position that `where` returns (px from the view's top left), or below
   * another label. Hides the label if `where` returns null.
   */
  place(where: (arm: string) => Point | null): void {
    const found = [...this.labels_].flatMap(([name, label]) => {
      const p = where(name);
      label.element.hidden = p === null;
      return p ? [{ label, p }] : [];
    });
    for (const { label } of found) label.width_px ||= label.element.offsetWidth;
    const is_short = this.labels_.size > kMostInWords;
    const labels = found.map(({ label, p }) => ({
      ...p, width_px: label.width_px, must: !is_short || ['lit', 'alarmed'].some((name) => label.element.classList.contains(name)),
    }));
    const room = { width_px: this.host_.clientWidth, height_px: this.host_.clientHeight - (is_short ? kBelowShort_px : kBelow_px) };
    const places = within_room(labels, stacked(labels, kHeight_px, kGap_px), room, kHeight_px, kMostBelow_px);
    found.forEach(({ label }, i) => {
      const at = places[i] ?? null;
      label.element.hidden = at === null;
      if (at) label.element.style.transform = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`;
    });
  }

  /** Hides all labels until they are placed again. */
  hide(): void {
    for (const { element } of this.labels_.values()) element.hidden = true;
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
  element.hidden = true;  // hidden until placed
  const glyph = document.createElement('span');
  state.className = 'state-word';
  element.append(name, glyph, state);
  return { element, name, glyph, state, width_px: 0 };
}
