// Validates the examples of an OpenAPI document, and what the program really answers to them, against the
// document's own schemas. Usage: node openapi_check.mjs PROGRAM OPENAPI.JSON
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import Ajv2020 from "ajv/dist/2020.js";

const [program, path] = process.argv.slice(2);
if (!path) throw new Error("usage: node openapi_check.mjs PROGRAM OPENAPI.JSON");
const document = JSON.parse(readFileSync(path, "utf8"));
const ajv = new Ajv2020({ allErrors: true, strict: true, strictTypes: false, strictRequired: false,
                          validateFormats: false });
for (const word of ["components", "paths", "info", "openapi", "servers", "tags", "security"]) ajv.addKeyword(word);
ajv.addSchema(document, "api");

let failures = 0;
function expect(name, value, wanted, what) {
  const validate = ajv.getSchema(`api#/components/schemas/${name}`);
  if (validate(value) === wanted) return;
  failures += 1;
  console.error(`${what}: ${wanted ? "isn't" : "is"} a ${name}`, JSON.stringify(validate.errors, null, 1));
}

function run(operation, request) {
  const answer = execFileSync(program, ["run", operation, "-", "-o", "-", "--format", "json"],
                              { input: JSON.stringify(request), maxBuffer: 1 << 28 });
  return JSON.parse(answer);
}

const generate = { count: 50, seed: 3, domain: { type: "torus", width: 2 } };
const more = {
  generate: [{ count: 50 }, { radius: 0.1 }, { method: "square", count: 9 }, { method: "jittered", count: 9, picture: "points" },
             { method: "two-radii", count: 30, beta: 2 }, { method: "delaunay-refinement", radius: 0.1 }, { method: "hexagonal", count: 8 }, generate],
  optimize: [{ points: { generate }, method: "opt-beta-local", max_sweeps: 2, damping: 0.5 },
             { points: { generate }, method: "opt-beta", beta: 0.8, randomness: "fast", max_visits: 50 },
             { points: { generate: { method: "white-noise", count: 50 } }, method: "opt-beta-local", max_sweeps: 2, enrich: true },
             { points: [[0, 0], [0.5, 0.1], [0.2, 0.7]], beta: 0.9, method: "opt-beta-local", max_sweeps: 2 },
             { points: { generate }, method: "push-pull", rho: 0.8, coverage: 0.7, max_sweeps: 20 }, { points: { generate }, method: "cvt", variant: "lloyd", max_sweeps: 3 },
             { points: { generate }, method: "distmesh", max_sweeps: 3 }, { points: { generate }, method: "far-point", max_sweeps: 2 }],
  analyze: [{ points: { generate }, measures: ["spacing"] }, { points: [[0, 0], [1.5, 0.1], [0.2, 0.7]], domain: { width: 2 } },
            { points: { points: [[0, 0], [1.5, 0.1], [0.2, 0.7]], domain: { width: 2 } } },
            { points: { generate }, seeds: 3, measures: document.components.schemas.AnalyzeRequest.properties.measures.items.oneOf[0].enum },
            { sets: [[[0, 0], [1.5, 0.1], [0.2, 0.7]], { generate: { count: 3, domain: { width: 2 } } }], domain: { width: 2 }, measures: [{ measure: "spectrum", range: 3 }] },
            { compare: [{ label: "a", points: { generate } }, { points: { optimize: { points: { generate }, beta: 0.8 } }, seeds: 2 }] }],
};
const refused = {
  generate: [{}, { count: 0 }, { count: 10, radius: 0.1 }, { method: "dart", count: 9 }, { method: "square", radius: 0.1 },
             { method: "two-radii", count: 9, beta: 1 },
             { count: 10, sed: 1 }, { count: 10, domain: { width: 0 } }, { count: 10, seed: -1 }],
  optimize: [{}, { points: { generate }, beta: 0.5 }, { points: { generate }, beta: 1 }, { points: { generate, job: "x" } },
             { points: { generate }, method: "opt-beta-local", max_sweeps: 0 }, { points: { generate }, method: "opt-beta", randomness: "wild" }, { points: { generate }, enrich: 1 }, { points: [[0, 0], [0.5], [0.2, 0.7]] }],
  analyze: [{}, { points: { generate }, measures: [] }, { points: { generate }, measures: ["taste"] }, { points: 3 },
            { points: { generate }, sets: [] }, { sets: [] }, { compare: [] }, { points: { generate }, seeds: 0 },
            { points: { generate }, measures: [{ measure: "spectrum", range: 0 }] }],
};
for (const operation of Object.keys(more)) {
  const name = operation[0].toUpperCase() + operation.slice(1);
  const { example } = document.paths[`/v1/${operation}`].post.requestBody.content["application/json"];
  for (const request of [example, ...more[operation]]) {
    expect(`${name}Request`, request, true, JSON.stringify(request));
    expect(`${name}Result`, run(operation, request), true, `the answer to ${JSON.stringify(request)}`);
  }
  for (const request of refused[operation]) {
    expect(`${name}Request`, request, false, JSON.stringify(request));
    let code = 0;
    try {
      execFileSync(program, ["run", operation, "-", "-o", "-", "--format", "json"], { input: JSON.stringify(request), stdio: "pipe" });
    } catch (error) {
      code = error.status;
      expect("Problem", JSON.parse(error.stderr), true, `the refusal of ${JSON.stringify(request)}`);
    }
    if (code === 0) {
      failures += 1;
      console.error(`${operation} takes ${JSON.stringify(request)}`);
    }
  }
}
if (failures > 0) process.exit(1);
console.log("examples, answers and refusals follow their schemas");
