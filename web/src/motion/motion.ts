// A timed motion of joints: waypoints joined by splines. Pure. Reads only what a preview needs. The
// server validates the trajectory.

export interface Motion {
  duration_s: number;
  names: readonly string[];
  /**
   * Returns the positions of all joints at a time, in rad or m. A joint whose own motion begins
   * later is at its start.
   */
  q_at(t_s: number): Record<string, number>;
}

export interface Waypoint { t_s: number; q: number[]; v: number[] | null; a: number[] | null }
export interface Piece { names: string[]; points: Waypoint[] }

/**
 * Reads a JointTrajectory as ROS prints it, or nested in another message as MoveIt does. Returns
 * null if it cannot be shown.
 */
export function read_trajectory(value: unknown): Piece | null {
  const trajectory = child(value, 'joint_trajectory') ?? value;
  const names = child(trajectory, 'joint_names');
  const points = child(trajectory, 'points');
  if (!is_list(names) || !names.every((name): name is string => typeof name === 'string') || !is_list(points)) return null;
  const read: Waypoint[] = [];
  for (const point of points) {
    const t_s = seconds_of(child(point, 'time_from_start'));
    const q = numbers_of(child(point, 'positions'));
    if (t_s === null || q?.length !== names.length || t_s < (read.at(-1)?.t_s ?? 0)) return null;
    read.push({ t_s, q, v: numbers_of(child(point, 'velocities')), a: numbers_of(child(point, 'accelerations')) });
  }
  return read.length === 0 ? null : { names, points: read };
}

export function motion_of_piece(piece: Piece): Motion {
  return {
    duration_s: piece.points.at(-1)?.t_s ?? 0, names: piece.names,
    q_at: (t_s) => {
      const values = position(piece.points, t_s);
      return Object.fromEntries(piece.names.map((name, i) => [name, values[i] ?? 0]));
    },
  };
}

/**
 * Returns the positions at a time. Interpolates like the server: quintic if accelerations are
 * given, cubic if only velocities are given, else linear.
 */
export function position(points: readonly Waypoint[], t_s: number): number[] {
  const next = after(points, t_s);
  const to = points[Math.min(next, points.length - 1)];
  const from = points[next - 1];
  if (!to) return [];
  if (next >= points.length || !from) return to.q;
  const h_s = to.t_s - from.t_s;
  const u = (t_s - from.t_s) / h_s;
  return to.q.map((q1, i) => {
    const q0 = from.q[i] ?? q1;
    const [v0, v1] = [from.v?.[i], to.v?.[i]];
    if (v0 === undefined || v1 === undefined) return q0 + u * (q1 - q0);
    const [a0, a1] = [from.a?.[i], to.a?.[i]];
    return a0 === undefined || a1 === undefined ? cubic(u, h_s, [q0, v0], [q1, v1]) : quintic(u, h_s, [q0, v0, a0], [q1, v1, a1]);
  });
}

/** Returns the index of the first point later than t_s. */
function after(points: readonly Waypoint[], t_s: number): number {
  let [low, high] = [0, points.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((points[middle]?.t_s ?? Infinity) > t_s) high = middle;
    else low = middle + 1;
  }
  return low;
}

function cubic(u: number, h_s: number, [q0, v0]: readonly [number, number], [q1, v1]: readonly [number, number]): number {
  return (1 - u) ** 2 * ((1 + 2 * u) * q0 + u * h_s * v0) + u ** 2 * ((3 - 2 * u) * q1 + (u - 1) * h_s * v1);
}

type State = readonly [q: number, v: number, a: number];

/**
 * Evaluates the quintic in Bernstein form. Its six control values follow from position, velocity
 * and acceleration at both ends.
 */
function quintic(u: number, h_s: number, [q0, v0, a0]: State, [q1, v1, a1]: State): number {
  const control = [
    q0, q0 + (h_s * v0) / 5, q0 + (2 * h_s * v0) / 5 + (h_s ** 2 * a0) / 20,
    q1 - (2 * h_s * v1) / 5 + (h_s ** 2 * a1) / 20, q1 - (h_s * v1) / 5, q1,
  ];
  const choose = [1, 5, 10, 10, 5, 1];
  return control.reduce((sum, b, k) => sum + (choose[k] ?? 0) * (1 - u) ** (5 - k) * u ** k * b, 0);
}

export function child(value: unknown, key: string): unknown {
  return typeof value === 'object' && value !== null ? (value as Record<string, unknown>)[key] : undefined;
}
const is_list = (value: unknown): value is unknown[] => Array.isArray(value);

function numbers_of(value: unknown): number[] | null {
  return is_list(value) && value.length > 0 && value.every((one): one is number => typeof one === 'number') ? value : null;
}

function seconds_of(value: unknown): number | null {
  if (typeof value === 'number') return value;
  const sec = child(value, 'sec') ?? child(value, 'secs');
  const nanosec = child(value, 'nanosec') ?? child(value, 'nsecs') ?? 0;
  return typeof sec === 'number' && typeof nanosec === 'number' ? sec + nanosec * 1e-9 : null;
}
