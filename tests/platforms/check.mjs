// The library as WebAssembly under node: the golden hashes of the tests, and the C interface.
//   node tests/platforms/check.mjs MODULE.wasm
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { SuperhelixError, load } from "../../bindings/wasm/superhelix.mjs";

const root = new URL("../../", import.meta.url);
const bytes = await readFile(process.argv[2]);
const api = JSON.parse(await readFile(new URL("bindings/api.json", root)));
const shx = await load(bytes, api);
const hex = (hash) => BigInt.asUintN(64, hash).toString(16).padStart(16, "0");

test("the module needs nothing of its host", () => {
  assert.deepEqual(WebAssembly.Module.imports(new WebAssembly.Module(bytes)), []);
});

test("every function of the header is exported", async () => {
  const names = (await readFile(new URL("include/exports.txt", root), "utf8")).trim().split("\n");
  assert.ok(names.length > 100);
  for (const name of names) assert.equal(typeof shx.exports[name], "function", name);
});

test("lanes of 128 bits and single numbers give the bits that every other machine gives", () => {
  const { lanes_count, lanes_golden, lanes_found, lanes_of_f64 } = shx.exports;
  assert.equal(lanes_of_f64(), 2);
  assert.ok(lanes_count() >= 6);
  for (let course = 0; course < lanes_count(); course++) {
    for (const scalar of [0, 1]) {
      assert.equal(hex(lanes_found(course, scalar)), hex(lanes_golden(course)), `course ${course}, ${scalar ? "scalar" : "lanes"}`);
    }
  }
});

test("contact gives the bits that every other machine gives", () => {
  const { contact_count, contact_golden, contact_found } = shx.exports;
  assert.ok(contact_count() >= 3);
  for (let course = 0; course < contact_count(); course++) {
    assert.equal(hex(contact_found(course)), hex(contact_golden(course)), `course ${course}`);
  }
});

test("every structure that states its size is filled at the size that this module gives it", () => {
  const filled = api.structs.filter((struct) => struct.versioned && struct.init !== null);
  assert.ok(filled.length > 20);
  for (const { name } of filled) {
    shx.scope(() => {
      const struct = shx.struct(name);
      const described = api.functions.find((each) => each.name === `${name}_init`);
      if (described.parameters.length !== 2) return;
      shx.call(`${name}_init`, struct, struct.size);
      assert.equal(struct.struct_size, struct.size, name);
    });
  }
});

test("memory of a scope is used again", () => {
  const pages = () => shx.exports.memory.buffer.byteLength / 65536;
  shx.scope(() => shx.allocate(3 << 20));
  const before = pages();
  for (let frame = 0; frame < 100; frame++) shx.scope(() => shx.allocate(3 << 20));
  assert.equal(pages(), before);
  const [kept, next] = [shx.allocate(16), shx.allocate(16)];
  assert.notEqual(kept, next);
});

test("errors name what is wrong, and what there is not is refused", () => {
  const refused = (body, code, text) =>
    assert.throws(body, (error) => error instanceof SuperhelixError && error.name === code && text.test(error.message));
  shx.scope(() => {
    const def = shx.filled("shx_solver_def");
    def.worker_count = 2;
    refused(() => shx.made("shx_solver_create", def), "SHX_ERROR_UNSUPPORTED", /worker_count.*2.*no threads/);
    const solver = shx.made("shx_solver_create", 0);
    refused(() => shx.call("shx_solver_step", solver, -1, 1, 0), "SHX_ERROR_INVALID_ARGUMENT", /dt.*-1/);
    const limits = shx.filled("shx_step_limits");
    limits.max_seconds = 0.5;
    refused(() => shx.call("shx_solver_step_with_limits", solver, 0.01, 1, limits, 0), "SHX_ERROR_UNSUPPORTED", /seconds.*0\.5.*no clock/);
    shx.call("shx_solver_destroy", solver);
    const path = shx.array(Uint8Array, 16);
    path.set(new TextEncoder().encode("groom.hair"));
    refused(() => shx.made("shx_curves_read", path), "SHX_ERROR_FILE", /groom\.hair/);
  });
  assert.match(shx.text(shx.call("shx_build_info")), /wasm32/);
});
