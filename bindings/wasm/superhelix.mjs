// The C interface as WebAssembly: loads the module, lays out its structures, turns error codes into exceptions.
//
//   const shx = await load(bytes, api);            bytes: superhelix.wasm, api: bindings/api.json, parsed
//   const solver = shx.made("shx_solver_create", 0);
//   const strand = shx.filled("shx_strand_def");   a structure with its defaults
//   strand.length = 0.2;
//   shx.call("shx_solver_add_strands", solver, strand, strand.size, 1, id);
//
// Numbers of 64 bits are BigInt, size_t and pointers are plain numbers (addresses in the module's memory). The module runs on the calling thread, without
// a clock: worker_count above 1 and limits in seconds are errors, and `seconds` of reports is 0.

const POINTER = 4;
const PAGE = 65536;

const SCALARS = {
  bool: [1, "Uint8"],
  char: [1, "Uint8"],
  int8_t: [1, "Int8"],
  uint8_t: [1, "Uint8"],
  int16_t: [2, "Int16"],
  uint16_t: [2, "Uint16"],
  int32_t: [4, "Int32"],
  uint32_t: [4, "Uint32"],
  int64_t: [8, "BigInt64"],
  uint64_t: [8, "BigUint64"],
  size_t: [POINTER, "Uint32"],
  float: [4, "Float32"],
  double: [8, "Float64"],
};

/** An error that the library reported: `code` is its number, `name` that of the constant. */
export class SuperhelixError extends Error {
  constructor(code, constant, text) {
    super(text);
    this.name = constant;
    this.code = code;
  }
}

/** Loads the module. */
export async function load(bytes, api) {
  const { instance } = await WebAssembly.instantiate(bytes, {});
  return new Superhelix(instance.exports, api);
}

export class Superhelix {
  #memory;
  #types = new Map();
  #functions = new Map();
  // A block of memory: where it begins, where it is free from, where it ends.
  #block = 0;
  #free = 0;
  #end = 0;

  constructor(exports, api) {
    this.exports = exports;
    this.#memory = exports.memory;
    this.constants = Object.fromEntries(api.constants.map((each) => [each.name, each.value]));
    this.codes = new Map(api.constants.filter((each) => each.name.startsWith("SHX_ERROR_")).map((each) => [each.value, each.name]));
    for (const [name, [size, kind]] of Object.entries(SCALARS)) this.#types.set(name, { size, alignment: size, kind });
    for (const each of api.aliases) this.#types.set(each.name, this.#types.get(each.type));
    for (const each of api.callbacks) this.#types.set(each.name, { size: POINTER, alignment: POINTER, kind: "Uint32" });
    const structs = new Map(api.structs.map((each) => [each.name, each]));
    for (const each of api.structs) this.#layOut(each, structs);
    for (const each of api.functions) this.#functions.set(each.name, each);
  }

  /** Size, alignment and fields of a type in this module, whose pointers have 4 bytes. */
  type(name) {
    const type = this.#types.get(name);
    if (type === undefined) throw new TypeError(`${name}: no such type`);
    return type;
  }

  #layOut(struct, structs) {
    if (this.#types.has(struct.name)) return;
    const fields = new Map();
    let [offset, alignment] = [0, 1];
    for (const field of struct.fields) {
      const isPointer = field.type.pointer > 0;
      if (!isPointer && structs.has(field.type.name)) this.#layOut(structs.get(field.type.name), structs);
      const type = isPointer ? { size: POINTER, alignment: POINTER, kind: "Uint32" } : this.type(field.type.name);
      offset = Math.ceil(offset / type.alignment) * type.alignment;
      fields.set(field.name, { offset, type, count: field.array });
      offset += type.size * Math.max(field.array, 1);
      alignment = Math.max(alignment, type.alignment);
    }
    this.#types.set(struct.name, { size: Math.ceil(offset / alignment) * alignment, alignment, fields, init: struct.init });
  }

  /** All of the module's memory. Get it again after every call: the memory may have grown, which empties the old view. */
  get view() {
    return new DataView(this.#memory.buffer);
  }

  /** The address of that many bytes, zeroed, aligned to 16. They live until the scope that they were asked for in ends, else for ever. */
  allocate(bytes) {
    const size = Math.ceil(bytes / 16) * 16;
    if (this.#free + size > this.#end) {
      const pages = Math.max(16, Math.ceil(size / PAGE));
      // Memory that the module did not ask for is never its allocator's.
      this.#block = this.#free = this.#memory.grow(pages) * PAGE;
      this.#end = this.#block + pages * PAGE;
    }
    const address = this.#free;
    this.#free += size;
    new Uint8Array(this.#memory.buffer, address, size).fill(0);
    return address;
  }

  /** Runs `body`; what it allocates is free afterwards. Give it a body that returns at once, not a promise. */
  scope(body) {
    const [block, free] = [this.#block, this.#free];
    try {
      return body();
    } finally {
      // Of a block that was begun in between all is free.
      this.#free = this.#block === block ? free : this.#block;
    }
  }

  /** Room for that many numbers: a typed array (Float32Array, Float64Array ...) over the module's memory, with `.byteOffset` as its address. */
  array(Kind, count) {
    return new Kind(this.#memory.buffer, this.allocate(count * Kind.BYTES_PER_ELEMENT), count);
  }

  /** A structure, zeroed: its fields can be read and set; `address` and `size` are for calls. */
  struct(name) {
    const type = this.type(name);
    return this.at(name, this.allocate(type.size));
  }

  /** The structure at an address. */
  at(name, address) {
    return new Proxy(new Struct(this, this.type(name), address), fieldsOf);
  }

  /** A structure that its init function has filled with the defaults. */
  filled(name) {
    const struct = this.struct(name);
    this.call(`${name}_init`, struct, struct.size);
    return struct;
  }

  /** Calls a function of the header by name. Structures and typed arrays are passed by their addresses. Throws where the function reports an error. */
  call(name, ...values) {
    const described = this.#functions.get(name);
    if (described === undefined) throw new TypeError(`${name}: no such function`);
    if (values.length !== described.parameters.length) {
      throw new TypeError(`${name} takes ${described.parameters.map((each) => each.name).join(", ")}; ${values.length} arguments were given`);
    }
    const result = this.exports[name](...values.map(addressOf));
    if (described.returns.pointer > 0 || ["uint32_t", "size_t"].includes(described.returns.name)) return result >>> 0;
    if (described.returns.name === "bool") return result !== 0;
    if (described.returns.name !== "shx_result" || result === this.constants.SHX_OK) return result;
    throw new SuperhelixError(result, this.codes.get(result) ?? `${result}`, this.#lastError());
  }

  /** Calls a function whose last parameter is a place for a handle, and gives the handle. */
  made(name, ...values) {
    return this.scope(() => {
      const place = this.allocate(POINTER);
      this.call(name, ...values, place);
      return this.view.getUint32(place, true);
    });
  }

  /** The text at an address, to its zero. */
  text(address) {
    const bytes = new Uint8Array(this.#memory.buffer, address);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  #lastError() {
    return this.scope(() => {
      const size = 1024;
      const place = this.allocate(size);
      this.exports.shx_last_error(place, size);
      return this.text(place);
    });
  }
}

function addressOf(value) {
  if (value instanceof Struct) return value.address;
  return ArrayBuffer.isView(value) ? value.byteOffset : value;
}

class Struct {
  constructor(library, type, address) {
    this.library = library;
    this.type = type;
    this.address = address;
  }

  get size() {
    return this.type.size;
  }
}

const fieldsOf = {
  get(struct, name) {
    const field = struct.type.fields.get(name);
    if (field === undefined) return Reflect.get(struct, name);
    const { offset, type, count } = field;
    const one = (index) => {
      const address = struct.address + offset + index * type.size;
      if (type.fields !== undefined) return new Proxy(new Struct(struct.library, type, address), fieldsOf);
      return struct.library.view[`get${type.kind}`](address, true);
    };
    return count > 0 ? Array.from({ length: count }, (_, index) => one(index)) : one(0);
  },
  set(struct, name, value) {
    const field = struct.type.fields.get(name);
    if (field === undefined) throw new TypeError(`${String(name)}: no such field`);
    const { offset, type, count } = field;
    const one = (index, value) => {
      const address = struct.address + offset + index * type.size;
      if (type.fields !== undefined) {
        const inner = new Proxy(new Struct(struct.library, type, address), fieldsOf);
        for (const [key, part] of Object.entries(value)) inner[key] = part;
      } else {
        struct.library.view[`set${type.kind}`](address, addressOf(value), true);
      }
    };
    if (count === 0) one(0, value);
    else if (value.length !== count) throw new TypeError(`${name} has ${count} entries; ${value.length} were given`);
    else value.forEach((each, index) => one(index, each));
    return true;
  },
};
