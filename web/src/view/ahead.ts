// The future of the arms in the 3D view: the tool paths of admitted motions with the granted
// authority, and a ghost where each arm comes to rest next.

import * as THREE from 'three';
import type { Motion } from '../motion/motion';
import type { Cell, Job } from '../server/messages';
import type { App } from '../state/app';
import { arm_color, ink } from '../state/palette';
import { Ghosts } from './ghosts';
import { Kinematics } from './kinematics';
import type { Surfaces } from './surfaces';
import { beads_of, Path } from './path';

const kSteps = 2;
const kGhostOpacity = 0.17;

interface Shown { path: Path; arm: string; job: string; motion: Motion }

export class Ahead {
  readonly group = new THREE.Group();
  private readonly ghosts_ = new Ghosts(kGhostOpacity);
  private kinematics_: Kinematics[] = [];
  private readonly paths_ = new Map<string, Shown>();
  private cell_: Cell | null = null;
  /** True while ghosts still have to be built. Each call of follow() builds one. */
  lacks_ghosts = false;
  private ghosts_at_ = '';
  private seen_ = '';

  constructor(private readonly app_: Pick<App, 'store' | 'motions' | 'settings'>) {
    this.group.add(this.ghosts_.group);
  }

  /** Discards all paths and ghosts, because the cell or the theme has changed. */
  begin(cell: Cell | null): void {
    for (const key of [...this.paths_.keys()]) this.forget(key);
    this.ghosts_.clear();
    this.ghosts_at_ = '';
    this.lacks_ghosts = false;
    if (cell === this.cell_) return;
    this.cell_ = cell;
    this.kinematics_ = [];
    for (const robot of cell?.robots ?? []) {
      try {
        this.kinematics_.push(new Kinematics(robot));
      } catch {
        // The error was reported when the robots were drawn.
      }
    }
  }

  get count(): number {
    return this.paths_.size;
  }

  /**
   * Updates paths and ghosts. If `at_now` is false, a past time is shown, and there is no
   * prediction to draw. Returns true if a visible part changed.
   */
  follow(surfaces: Surfaces, at_now: boolean): boolean {
    const { settings, store } = this.app_;
    const steps = at_now ? this.steps() : [];
    const wanted = new Set(settings.shows.value.paths ? steps.map(({ arm, job }) => `${arm}\n${job.id}`) : []);
    for (const [key, { motion, job }] of [...this.paths_]) {
      const known = this.app_.store.job(job);
      if (!wanted.has(key) || !known || this.app_.motions.of(known) !== motion) this.forget(key);
    }
    for (const step of steps) if (settings.shows.value.paths) this.add(step.arm, step.job);
    this.show_ghosts(settings.shows.value.ghosts ? steps : [], surfaces);
    this.move();
    const granted = store.motions.map(({ job, authority_s }) => `${job} ${authority_s}`);
    const seen = [...this.paths_.keys(), ...granted, this.ghosts_at_].join('\n');
    const changed = seen !== this.seen_;
    this.seen_ = seen;
    return changed;
  }

  /** Moves the paths to the progress and authority in the last frame. */
  move(): void {
    for (const { path, arm, job, motion } of this.paths_.values()) {
      const authority = this.app_.store.motions.find((one) => one.arm === arm && one.job === job);
      path.show(authority ? { from_s: authority.progress_s, granted_s: authority.authority_s } : { from_s: 0, granted_s: 0 });
      path.group.visible = authority === undefined || authority.progress_s < motion.duration_s;
    }
  }

  /** Shows the ghosts, or hides them because drawing is slow. */
  show_level(ghosts: boolean): void {
    this.ghosts_.group.visible = ghosts;
  }

  /** Returns up to two predicted jobs for each arm, the current job first. */
  private steps(): { arm: string; job: Job }[] {
    const { store } = this.app_;
    return (store.forecast?.arms ?? []).flatMap(({ name, steps }) => steps
      .flatMap((step) => {
        const job = store.job(step.id);
        return job && job.result === null ? [{ arm: name, job }] : [];
      })
      .slice(0, kSteps));
  }

  private add(arm: string, job: Job): void {
    const key = `${arm}\n${job.id}`;
    if (this.paths_.has(key)) return;
    const motion = this.app_.motions.of(job);
    const robot = this.cell_?.robots.find((one) => one.arms.some(({ name }) => name === arm));
    const kinematics = this.kinematics_.find(({ name }) => name === robot?.name);
    if (!motion || !kinematics) return;
    const count = beads_of(motion.duration_s);
    const points: THREE.Vector3[] = [];
    for (let i = 0; i < count; i++) {
      kinematics.set_q({ ...this.app_.store.q, ...motion.q_at((motion.duration_s * i) / (count - 1)) });
      const p_W = kinematics.tool(arm);
      if (p_W) points.push(p_W);
    }
    if (points.length === 0) return;
    const path = new Path(points, motion.duration_s);
    path.paint(ink(arm_color([...this.app_.store.arms.keys()], arm)));
    this.paths_.set(key, { path, arm, job: job.id, motion });
    this.group.add(path.group);
  }

  /**
   * Shows a ghost where each arm's current motion ends, or its next motion if the arm is at rest.
   */
  private show_ghosts(steps: readonly { arm: string; job: Job }[], surfaces: Surfaces): void {
    if (!this.cell_) return;
    const q: Record<string, number> = {};
    const ends: string[] = [];
    const seen = new Set<string>();
    for (const { arm, job } of steps) {
      const motion = seen.has(arm) ? null : this.app_.motions.of(job);
      seen.add(arm);
      if (!motion) continue;
      Object.assign(q, motion.q_at(motion.duration_s));
      ends.push(job.id, String(motion.duration_s));
    }
    const at = ends.join('\n');
    if (at === this.ghosts_at_) return;
    const names = [...this.app_.store.arms.keys()];
    const all = this.ghosts_.show({ q: ends.length === 0 ? null : q, now: this.app_.store.q }, this.cell_, surfaces, (arm) => ink(arm_color(names, arm)));
    this.lacks_ghosts = !all;
    this.ghosts_at_ = all ? at : `${at}\n${this.ghosts_.count}`;
  }

  private forget(key: string): void {
    const shown = this.paths_.get(key);
    if (!shown) return;
    this.group.remove(shown.path.group);
    shown.path.close();
    this.paths_.delete(key);
  }
}
