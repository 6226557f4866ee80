// Checks responses against openapi.json, which must list their status, content type, headers and schema. Records every
// status seen.
import assert from 'node:assert/strict';
import {createRequire} from 'node:module';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const Ajv = require('ajv/dist/2020').default;

// Schemas refer to each other within the document; Ajv knows each by name.
const byName = (schema) => JSON.parse(JSON.stringify(schema).replaceAll('"#/components/schemas/', '"armloom:'));

export class Contract {
  constructor(document) {
    this.document = document;
    this.seen = new Map();  // "POST /jobs" -> Set of statuses
    this.messages = new Map();  // event type -> count
    this.ajv = new Ajv({strict: true, strictRequired: false, allErrors: true, allowUnionTypes: true});
    for (const keyword of ['discriminator', 'example']) this.ajv.addKeyword(keyword);
    this.ajv.addFormat('date-time', /^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$/);
    this.ajv.addFormat('uuid', /^[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}$/);
    this.ajv.addFormat('binary', true);
    for (const [name, schema] of Object.entries(document.components.schemas)) {
      this.ajv.addSchema(byName(schema), `armloom:${name}`);
    }
    this.compiled = new Map();
  }

  operations() {
    return Object.entries(this.document.paths).flatMap(([path, methods]) =>
      Object.entries(methods).map(([method, operation]) => ({path, method: method.toUpperCase(), operation})));
  }

  // Returns what is wrong with `value`, or null.
  faults(schema, value) {
    if (!this.compiled.has(schema)) this.compiled.set(schema, this.ajv.compile(byName(schema)));
    const validate = this.compiled.get(schema);
    return validate(value) ? null : this.ajv.errorsText(validate.errors, {separator: '\n  '});
  }

  schema(name, value, what = name) {
    const faults = this.faults(this.document.components.schemas[name], value);
    assert.equal(faults, null, `${what} is no ${name}:\n  ${faults}\n  ${JSON.stringify(value).slice(0, 1500)}`);
  }

  message(value) {
    this.messages.set(value.type, (this.messages.get(value.type) ?? 0) + 1);
    this.schema(value.type === 'state' ? 'StateFrame' : `${value.type[0].toUpperCase()}${value.type.slice(1)}Event`,
                value, 'a message');
  }

  // Compiles every schema, to find unknown keywords and dangling references.
  compileAll() {
    for (const schema of Object.values(this.document.components.schemas)) this.faults(schema, {});
  }

  // Returns true if `body` fits the operation's body schema.
  fitsBody(path, method, body) {
    const {content} = this.document.paths[path][method.toLowerCase()].requestBody;
    return this.faults(content['application/json'].schema, body) === null;
  }

  answer(path, method, {status, headers, text}) {
    const what = `${method} ${path} -> ${status}`;
    const operation = this.document.paths[path]?.[method.toLowerCase()];
    assert.ok(operation, `${method} ${path} is not in openapi.json`);
    let response = operation.responses[status];
    assert.ok(response, `${what} is not listed; listed: ${Object.keys(operation.responses)}\n  ${text.slice(0, 500)}`);
    if (response.$ref) response = this.document.components.responses[response.$ref.split('/').at(-1)];
    const type = headers['content-type']?.split(';')[0];
    const contents = response.content ?? {};
    if (Object.keys(contents).length === 0) {
      assert.equal(text, '', `${what} has a body`);
    } else {
      assert.ok(type in contents, `${what} is ${type}; listed: ${Object.keys(contents)}`);
    }
    for (const name of Object.keys(response.headers ?? {})) {
      assert.ok(headers[name.toLowerCase()], `${what} has no ${name}`);
    }
    if (type === 'application/json' || type?.endsWith('+json')) {
      const faults = this.faults(contents[type].schema, JSON.parse(text));
      assert.equal(faults, null, `${what}:\n  ${faults}\n  ${text.slice(0, 1500)}`);
    }
    this.saw(path, method, status);
  }

  saw(path, method, status) {
    const key = `${method} ${path}`;
    this.seen.set(key, (this.seen.get(key) ?? new Set()).add(String(status)));
  }
}
