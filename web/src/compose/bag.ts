// What was pasted: one job, or a bag of jobs. Pure. The server judges what is in it; here it is only
// seen how many there are.

export type Bag =
  | { kind: 'one'; text: string }
  | { kind: 'bag'; jobs: unknown[] };

/** A list of bodies, a list of {"at", "job"} as in a jobs file, or {"jobs": […]}; anything else is one body. */
export function read_bag(text: string): Bag {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return { kind: 'one', text };
  }
  const list = Array.isArray(value) ? value : (value as { jobs?: unknown } | null)?.jobs;
  if (!Array.isArray(list) || list.length === 0) return { kind: 'one', text };
  return { kind: 'bag', jobs: list.map((entry) => (entry as { job?: unknown } | null)?.job ?? entry) };
}

/** Each body with a name for people. */
export function bodies_of(bag: Bag): { title: string; text: string }[] {
  if (bag.kind === 'one') return [{ title: 'This job', text: bag.text }];
  return bag.jobs.map((job, i) => {
    const { id, name } = (job ?? {}) as { id?: unknown; name?: unknown };
    const title = [id, name].find((one): one is string => typeof one === 'string' && one !== '');
    return { title: title ?? `job ${i + 1}`, text: JSON.stringify(job) };
  });
}
