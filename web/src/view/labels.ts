// A label under each arm: its name and its state, in words, a glyph and a colour.

import type { Arm } from '../server/messages';
import { arm_colour, kStateColours, kStateGlyphs } from '../state/palette';

const kHeight_px = 22;
const kGap_px = 4;

interface Point { x: number; y: number }
interface Label { element: HTMLElement; name: HTMLElement; state: HTMLElement; width_px: number }

export class ArmLabels {
  private readonly labels_ = new Map<string, Label>();

  constructor(private readonly host_: HTMLElement) {}

  show(arm: Arm, arms: readonly string[]): void {
    let label = this.labels_.get(arm.name);
    if (!label) {
      label = make_label();
      this.labels_.set(arm.name, label);
      this.host_.append(label.element);
    }
    label.name.textContent = arm.name;
    const state = `${kStateGlyphs[arm.state]} ${arm.state}`;
    if (label.state.textContent !== state) label.width_px = 0;
    label.state.textContent = state;
    label.element.style.setProperty('--arm', arm_colour(arms, arm.name));
    label.element.style.setProperty('--state', kStateColours[arm.state]);
  }

  light(arms: readonly string[]): void {
    for (const [name, label] of this.labels_) label.element.classList.toggle('lit', arms.includes(name));
  }

  /** Puts each where the function says, px from the view's top left, or below one that is there; null hides it. */
  place(where: (arm: string) => Point | null): void {
    const found = [...this.labels_].map(([name, label]) => ({ label, p: where(name) }));
    const placed: { p: Point; width_px: number }[] = [];
    for (const { label, p } of found.sort((a, b) => (a.p?.x ?? 0) - (b.p?.x ?? 0))) {
      label.element.hidden = p === null;
      if (!p) continue;
      label.width_px ||= label.element.offsetWidth;
      const { width_px } = label;
      const in_the_way = (other: { p: Point; width_px: number }) =>
        Math.abs(other.p.x - p.x) < (other.width_px + width_px) / 2 + kGap_px && Math.abs(other.p.y - p.y) < kHeight_px;
      for (let other = placed.find(in_the_way); other; other = placed.find(in_the_way)) p.y = other.p.y + kHeight_px;
      placed.push({ p, width_px });
      label.element.style.transform = `translate(${p.x.toFixed(1)}px, ${p.y.toFixed(1)}px)`;
    }
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
