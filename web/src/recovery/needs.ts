// Finds what stopped the arms, and what each arm needs to continue. Pure.

import type { Arm, Job } from '../server/messages';
import { step_in_words } from '../jobs/steps';
import { is_halted, is_stopped } from '../state/shown_state';
import type { Notice } from '../state/notices';
import type { Store } from '../state/store';
import { kText } from '../strings';
import { title_of } from '../wording';

const kWords = kText.recovery;

/** Returns the last event that stopped arms, or null if the page knows none. */
export function cause_of(notices: readonly Notice[]): Notice | null {
  return notices.find(({ text, source, level }) => /^stopped: /.test(text) || (source === 'monitor' && level === 'error') || /fault/.test(text)) ?? null;
}

/**
 * Returns the arms that must be resumed: arms that are stopped, have a fault, have lost the link to
 * their controller, or are braking to a stop.
 */
export function waiting_arms(store: Pick<Store, 'arms' | 'job_of'>): Arm[] {
  return [...store.arms.values()].filter((arm) => is_halted(arm) || is_stopped(store.job_of(arm), arm.name));
}

export interface Need { words: string; resume: boolean; home: boolean }

const kAtHome_rad = 0.02;

/**
 * Describes what an arm needs. `job` is its unfinished job. `pose` are the joint positions, null if
 * unknown. `next` is the job that follows.
 */
export function need_of(arm: Arm, job: Job | null, pose: Readonly<Record<string, number>> | null, next: Job | null = null): Need {
  const name = job ? title_of(job) : '';
  if (arm.link === 'lost') return { words: kWords.lost, resume: true, home: false };
  if (arm.link === 'connecting') return { words: kWords.connecting, resume: false, home: false };
  switch (arm.state) {
    case 'fault':
      return { words: kWords.fault(next ? kWords.fault_next(title_of(next)) : ''), resume: true, home: false };
    case 'stopped':
      return job
        ? { words: kWords.resume_job(name, step_in_words(job, true) ?? kWords.share_of_path(Math.round(100 * job.progress))), resume: true, home: false }
        : { words: next ? kWords.resume_next(title_of(next)) : kWords.resume_idle, resume: true, home: false };
    case 'paused': {
      const step = job && step_in_words(job, true);
      return { words: step ? kWords.between_steps(name, step) : kWords.paused(name || kWords.its_job_words), resume: false, home: false };
    }
    case 'moving':
      return { words: is_stopped(job, arm.name) ? kWords.brakes : kWords.moves(name || kWords.its_job_words), resume: false, home: false };
    case 'idle':
      if (job) return { words: kWords.between_steps(name, step_in_words(job, true) ?? ''), resume: false, home: false };
      if (!pose) return { words: kWords.ready_unknown, resume: false, home: false };
      return is_away(arm, pose) ? { words: kWords.ready_away, resume: false, home: true } : { words: kWords.ready, resume: false, home: false };
  }
}

function is_away({ joints, home }: Arm, pose: Readonly<Record<string, number>>): boolean {
  return joints.some((joint, i) => Math.abs((pose[joint] ?? home[i] ?? 0) - (home[i] ?? 0)) > kAtHome_rad);
}
