// A label under each arm: its name and its state, in words, a glyph and a colour.

import type { Arm } from '../server/messages';
import { arm_colour, kStateColours, kStateGlyphs } from '../state/palette';

interface Label { element: HTMLElement; name: HTMLElement; state: HTMLElement }

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
    label.state.textContent = `${kStateGlyphs[arm.state]} ${arm.state}`;
    label.element.style.setProperty('--arm', arm_colour(arms, arm.name));
    label.element.style.setProperty('--state', kStateColours[arm.state]);
  }

  light(arms: readonly string[]): void {
    for (const [name, label] of this.labels_) label.element.classList.toggle('lit', arms.includes(name));
  }

  /** Puts each where the function says, px from the view's top left; null hides it. */
  place(where: (arm: string) => { x: number; y: number } | null): void {
    for (const [name, label] of this.labels_) {
      const p = where(name);
      label.element.hidden = p === null;
      if (p) label.element.style.transform = `translate(${p.x.toFixed(1)}px, ${p.y.toFixed(1)}px)`;
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
  return { element, name, state };
}
