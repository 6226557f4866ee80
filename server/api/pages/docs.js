"use strict";
// Makes an element. Children are inserted as text, never as HTML.
function element(name, attributes, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
  made.append(...children.flat().filter((child) => child !== undefined && child !== null && child !== ""));
  return made;
}
// Turns `code` in a description into code elements.
const prose = (text) => (text || "").split("`").map((part, i) => (i % 2 ? element("code", {}, part) : part));
const short = (ref) => ref.split("/").pop();
const schemaLink = (ref) => element("a", {href: "#schema-" + short(ref)}, short(ref));

function join(parts, separator) {
  return parts.flatMap((part, i) => (i ? [separator, part] : [part])).flat();
}
// Returns a short form of a schema: "Job[]", "number ≥ 0 | null".
function typeOf(schema) {
  if (schema.$ref) return [schemaLink(schema.$ref)];
  if ("const" in schema) return [element("code", {}, JSON.stringify(schema.const))];
  if (schema.enum) return join(schema.enum.map((value) => [element("code", {}, JSON.stringify(value))]), " ");
  if (schema.oneOf && !schema.properties) return join(schema.oneOf.map(typeOf), " | ");
  if (schema.type === "array") {
    const size = schema.minItems !== undefined && schema.minItems === schema.maxItems ? schema.minItems : "";
    const bounds = size === "" && schema.maxItems ? " (at most " + schema.maxItems.toLocaleString("en") + ")" : "";
    return [...(schema.items ? typeOf(schema.items) : []), "[" + size + "]" + bounds];
  }
  if (schema.type === "object" && typeof schema.additionalProperties === "object") {
    return ["{name: ", ...typeOf(schema.additionalProperties), "}"];
  }
  const bounds = [];
  if (schema.minimum !== undefined) bounds.push("≥ " + schema.minimum);
  if (schema.exclusiveMinimum !== undefined) bounds.push("> " + schema.exclusiveMinimum);
  if (schema.maximum !== undefined) bounds.push("≤ " + schema.maximum);
  if (schema.maxLength !== undefined) bounds.push("≤ " + schema.maxLength + " characters");
  if (schema.format) bounds.push(schema.format);
  if (schema.pattern) bounds.push(schema.pattern);
  return [[].concat(schema.type || "any").join(" | ") + (bounds.length ? " " + bounds.join(", ") : "")];
}
function objectsWithin(schema) {
  if (schema.properties) return [schema];
  if (schema.items) return objectsWithin(schema.items);
  return (schema.oneOf || []).flatMap(objectsWithin);
}
function propertyRows(schema, depth) {
  const rows = [];
  for (const [name, property] of Object.entries(schema.properties || {})) {
    const optional = !(schema.required || []).includes(name);
    const fallback = property.default === undefined ? "" : " Default: " + JSON.stringify(property.default) + ".";
    const inner = property.$ref ? [] : objectsWithin(property);
    rows.push(element("tr", {},
      element("td", {class: "name deep" + depth + (optional ? " opt" : "")}, name),
      element("td", {}, inner.length && property.properties ? "object" : typeOf(property)),
      element("td", {class: "soft"}, prose((property.description || "") + fallback))));
    for (const object of inner) rows.push(...propertyRows(object, Math.min(depth + 1, 3)));
  }
  return rows;
}
function schemaView(schema) {
  const objects = schema.properties ? [schema] : [];
  const one = schema.properties && schema.oneOf
    ? element("p", {class: "soft"}, "Exactly one of " + schema.oneOf.map((o) => o.required[0]).join(", ") + ".") : "";
  if (!objects.length) return [element("p", {}, ...typeOf(schema))];
  return [element("table", {}, element("tbody", {}, propertyRows(schema, 0))), one];
}
function exampleView(label, value) {
  return [element("h3", {}, label), element("pre", {tabindex: "0"}, JSON.stringify(value, null, 1)
    .replace(/([[{])\s+([^[\]{}]*?)\s+([\]}])/g, (all, open, inner, close) => open + inner.replace(/\s*\n\s*/g, " ") + close))];
}
function operationView(document_, path, method, operation) {
  const body = [];
  if (operation.description) body.push(element("p", {}, prose(operation.description)));
  if (operation.parameters) {
    body.push(element("h3", {}, "Parameters"), element("table", {}, element("tbody", {}, operation.parameters.map((p) =>
      element("tr", {}, element("td", {class: "name" + (p.required ? "" : " opt")}, p.name),
        element("td", {}, ...typeOf(p.schema), element("span", {class: "soft"}, " in " + p.in)),
        element("td", {class: "soft"}, prose(p.description)))))));
  }
  for (const [type, content] of Object.entries(operation.requestBody ? operation.requestBody.content : {})) {
    body.push(element("h3", {}, "Body"), element("p", {}, element("code", {}, type), " ", ...typeOf(content.schema)));
    for (const [name, example] of Object.entries(content.examples || {})) {
      body.push(...exampleView("Example: " + name, example.value));
    }
  }
  const rows = Object.entries(operation.responses).map(([status, given]) => {
    const response = given.$ref ? document_.components.responses[short(given.$ref)] : given;
    const contents = Object.entries(response.content || {});
    return element("tr", {}, element("td", {class: "name"}, status),
      element("td", {}, contents.length ? join(contents.map(([type, c]) =>
        type === "application/json" || type === "application/problem+json" ? typeOf(c.schema) : [element("code", {}, type)]), ", ") : ""),
      element("td", {class: "soft"}, prose(response.description)));
  });
  body.push(element("h3", {}, "Responses"), element("table", {}, element("tbody", {}, rows)));
  return element("details", {id: operation.operationId}, element("summary", {},
    element("b", {class: method}, method.toUpperCase()), element("code", {}, path),
    element("span", {}, operation.summary || "")), element("div", {}, body));
}
function render(document_) {
  const nav = document.querySelector("nav");
  const main = document.querySelector("main");
  const operations = Object.entries(document_.paths).flatMap(([path, methods]) =>
    Object.entries(methods).map(([method, operation]) => ({path, method, operation})));
  main.replaceChildren(element("h1", {}, document_.info.title), element("p", {}, document_.info.summary),
    ...document_.info.description.split("\n\n").map((text) => element("p", {}, prose(text))),
    element("p", {}, element("a", {href: "/openapi.json"}, "openapi.json"), " · ", element("a", {href: "/"}, "dashboard")));
  for (const tag of document_.tags) {
    const own = operations.filter(({operation}) => operation.tags.includes(tag.name));
    nav.append(element("h2", {}, tag.name), ...own.map(({path, method, operation}) =>
      element("a", {href: "#" + operation.operationId, title: operation.summary},
        element("b", {class: method}, method === "delete" ? "DEL" : method.toUpperCase()), path.replace("/api/v1", ""))));
    main.append(element("h2", {}, tag.name[0].toUpperCase() + tag.name.slice(1)), element("p", {}, tag.description),
      ...own.map(({path, method, operation}) => operationView(document_, path, method, operation)));
  }
  nav.append(element("h2", {}, "schemas"));
  main.append(element("h2", {}, "Schemas"), element("p", {}, "A question mark marks optional members."));
  for (const [name, schema] of Object.entries(document_.components.schemas)) {
    nav.append(element("a", {href: "#schema-" + name}, name));
    main.append(element("details", {id: "schema-" + name}, element("summary", {}, element("code", {}, name)),
      element("div", {}, schema.description ? element("p", {}, prose(schema.description)) : "", schemaView(schema))));
  }
}
function openTarget() {
  const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!target || target.tagName !== "DETAILS") return;
  target.open = true;
  target.scrollIntoView();
}
addEventListener("hashchange", openTarget);
fetch("openapi.json").then((answer) => answer.json()).then((document_) => { render(document_); openTarget(); })
  .catch((error) => document.querySelector("main").append(element("p", {role: "alert"}, "openapi.json cannot be read: " + error)));
