// Stacks labels that would overlap. Pure.

export interface Placed { x: number; y: number; width_px: number }

/**
 * Returns the y of each label, from left to right. A label that would overlap placed labels is
 * moved below them. Each label checks the placed labels once, from the top, and only moves down, so
 * the loop always ends.
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
      const is_clear = Math.abs(other.x - own.x) >= (other.width_px + own.width_px) / 2 + gap_px;
      if (!is_clear && Math.abs(other.y - own.y) < height_px) own.y = other.y + height_px;
    }
    y[i] = own.y;
    placed.push(own);
    placed.sort((a, b) => a.y - b.y);
  }
  return y;
}

export interface Room { width_px: number; height_px: number }

/**
 * Returns the center x and the top y of each label, moved into the view. Null if the label was
 * moved down by more than `most_px` or does not fit, unless it `must` be visible.
 */
export function within_room(labels: readonly (Placed & { must: boolean })[], y: readonly number[], room: Room, height_px: number, most_px: number): ({ x: number; y: number } | null)[] {
  return labels.map((label, i) => {
    const at = y[i] ?? label.y;
    const half = label.width_px / 2;
    if (!label.must && (at - label.y > most_px || at + height_px > room.height_px)) return null;
    return { x: Math.max(half, Math.min(room.width_px - half, label.x)), y: Math.max(0, Math.min(room.height_px - height_px, at)) };
  });
}
