// node differences.mjs BEFORE AFTER: prints the differences in meaning between two OpenAPI documents. Keys
// and unordered lists are sorted, descriptions, titles and examples are left out, and equivalent forms are
// unified.
import fs from 'node:fs';

const kUnordered = new Set(['required', 'enum', 'type', 'oneOf', 'anyOf', 'allOf', 'parameters']);
const kSilent = new Set(['description', 'title', 'summary', 'examples', 'discriminator']);

export function meaning(document) {
  const plain = (node, inProperties = false) => {
    if (Array.isArray(node)) return node.map((element) => plain(element));
    if (typeof node !== 'object' || node === null) return node;
    if (node.$ref?.startsWith('#/components/responses/')) {
      return plain(document.components.responses[node.$ref.split('/').at(-1)]);
    }
    const out = {};
    for (const key of Object.keys(node).sort()) {
      if (!inProperties && kSilent.has(key)) continue;
      const value = plain(node[key], key === 'properties');
      out[key] = !inProperties && kUnordered.has(key) && Array.isArray(value)
        ? [...value].sort((a, b) => (JSON.stringify(a) < JSON.stringify(b) ? -1 : 1)) : value;
    }
    // allOf with one rule is equivalent to that rule.
    if (!inProperties && out.allOf?.length === 1 && !Object.keys(out.allOf[0]).some((key) => key in out)) {
      Object.assign(out, out.allOf[0]);
      delete out.allOf;
    }
    return out;
  };
  return {paths: plain(document.paths), schemas: plain(document.components.schemas, true)};
}

export function differences(before, after, at = '') {
  if (JSON.stringify(before) === JSON.stringify(after)) return [];
  const both = [before, after].every((v) => typeof v === 'object' && v !== null && !Array.isArray(v));
  if (!both) return [`${at}: ${JSON.stringify(before)?.slice(0, 160) ?? 'nothing'} -> ${JSON.stringify(after)?.slice(0, 160) ?? 'nothing'}`];
  const keys = [...new Set([...Object.keys(before), ...Object.keys(after)])].sort();
  return keys.flatMap((key) => differences(before[key], after[key], `${at}/${key}`));
}

if (process.argv[1] === new URL(import.meta.url).pathname) {
  const [before, after] = process.argv.slice(2).map((file) => meaning(JSON.parse(fs.readFileSync(file, 'utf8'))));
  for (const line of differences(before, after)) console.log(line);
}
