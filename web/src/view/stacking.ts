// Labels that would lie on each other are put below each other. Pure.

export interface Placed { x: number; y: number; width_px: number }

/**
 * Where each is put, in the order given: as it is, or below those from left to right that are in its way.
 * Each looks once at those that are placed, from the top down, and only ever goes down: it ends, whatever
 * the numbers are rounded to.
 */
export function stacked(labels: readonly Placed[], height_px: number, gap_px: number): number[] {
  const placed: Placed[] = [];
  const y = labels.map((label) => label.y);
  const from_left = labels.map((_, i) => i).sort((i, k) => (labels[i]?.x ?? 0) - (labels[k]?.x ?? 0));
  for (const i of from_left) {
    const label = labels[i];
    if (!label) continue;
    const own = { ...label };
    for (const other of placed) {
      const beside = Math.abs(other.x - own.x) >= (other.width_px + own.width_px) / 2 + gap_px;
      if (!beside && Math.abs(other.y - own.y) < height_px) own.y = other.y + height_px;
    }
    y[i] = own.y;
    placed.push(own);
    placed.sort((a, b) => a.y - b.y);
  }
  return y;
}
