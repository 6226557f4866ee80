import { describe, expect, it } from 'vitest';
import css from '../src/style/tokens.css?raw';

type Triple = [number, number, number];
type Eye = 'all' | 'no red' | 'no green' | 'no blue';

// How eyes without one of the three cones see linear sRGB. From Machado, Oliveira, Fernandes 2009,
// severity 1.
const kEyes: Record<Eye, readonly [Triple, Triple, Triple]> = {
  'all': [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  'no red': [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  'no green': [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
  'no blue': [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
};
// A distance of 2 in CIELAB is just visible if two colors are side by side. Marks that are apart
// from each other need several times that.
const kLeastOfTwo = 20;
const kLeastOfFour = 12;

const [dark = '', light = ''] = css.split(":root[data-theme='light']");

function color(theme: string, name: string): Triple {
  const hex = new RegExp(`${name}: #([0-9a-f]{6})`).exec(theme)?.[1];
  if (hex === undefined) throw new Error(`no ${name}`);
  const [r, g, b] = [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
  return [r ?? 0, g ?? 0, b ?? 0];
}

const times = (rows: readonly Triple[], [x, y, z]: Triple) => rows.map(([a, b, c]) => Math.min(1, Math.max(0, a * x + b * y + c * z))) as Triple;

function lab(rgb: Triple): Triple {
  const [x, y, z] = times([[0.4339, 0.3762, 0.1899], [0.2126, 0.7152, 0.0722], [0.0177, 0.1095, 0.8728]], rgb)
    .map((v) => (v > 0.008856 ? Math.cbrt(v) : 7.787 * v + 16 / 116)) as Triple;
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

function apart(theme: string, a: number | string, b: number | string, eye: Eye): number {
  const [p, q] = [a, b].map((one) => lab(times(kEyes[eye], color(theme, typeof one === 'number' ? `--arm-${one}` : one)))) as [Triple, Triple];
  return Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

describe.each([['dark', dark], ['light', light]])('Arm colors, %s', (_, theme) => {
  it.each(Object.keys(kEyes) as Eye[])('are distinguishable with %s', (eye) => {
    expect(apart(theme, 0, 1, eye)).toBeGreaterThan(kLeastOfTwo);
    // A held object has its arm's color, and must differ from objects of the scene.
    for (let arm = 0; arm < 8; arm++) expect(apart(theme, arm, '--object', eye), `arm ${arm}`).toBeGreaterThan(kLeastOfTwo);
    for (const a of [0, 1, 2, 3]) for (let b = a + 1; b < 4; b++) expect(apart(theme, a, b, eye), `arms ${a} and ${b}`).toBeGreaterThan(kLeastOfFour);
  });
});
