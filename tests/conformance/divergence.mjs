// Subgroup operations that not all invocations of a subgroup come to, in the SPIR-V of shaders that count on all of
// them (shaders/mesher/tape.glsl). Software Vulkan forgives them: its lanes hand on what they hold even where they are
// masked. Hardware does not.
//
//   node divergence.mjs SPIRV-DIS FILE.spv...      status 1 where one is found
//
// A value diverges where invocations may see different ones. That is what an invocation's number brings, what reads it,
// and what is written where a diverging branch has parted them; reading a buffer at one place gives one value. Whoever
// calls is not told apart, nor the order of writes: so it may suspect too much, but overlooks nothing of that.
import { execFileSync } from 'node:child_process';
import { basename } from 'node:path';

const NUMBERS = ['LocalInvocationId', 'LocalInvocationIndex', 'GlobalInvocationId', 'SubgroupLocalInvocationId'];
const BUFFERS = ['StorageBuffer', 'Uniform', 'PushConstant'];
const TERMINATORS = ['OpBranchConditional', 'OpSwitch'];
const BRANCHES = ['OpBranch', ...TERMINATORS];
const isAccess = (op) => op === 'OpAccessChain' || op === 'OpInBoundsAccessChain';
const needsAll = (op) => op.startsWith('OpGroupNonUniform') || op === 'OpControlBarrier';

/** Of a module's text: functions with their blocks of instructions, and all that stands outside of them. */
function parse(text) {
  const module = { names: new Map(), builtins: new Map(), globals: new Map(), functions: new Map() };
  let current = null;
  let block = null;
  for (const line of text.split('\n')) {
    const [, result, op, rest] = /^(?:(%\S+) = )?(Op\w+)\s*(.*)$/.exec(line) ?? [];
    if (!op) continue;
    const operands = rest.split(' ');
    if (op === 'OpName') module.names.set(operands[0], operands[1].replaceAll('"', '').replace(/\(.*/, ''));
    else if (op === 'OpDecorate' && operands[1] === 'BuiltIn') module.builtins.set(operands[0], operands[2]);
    else if (op === 'OpFunction') module.functions.set(result, (current = { parameters: [], blocks: new Map() }));
    else if (op === 'OpFunctionEnd') current = null;
    else if (!current) module.globals.set(result, { op, operands });
    else if (op === 'OpFunctionParameter') current.parameters.push(result);
    else if (op === 'OpLabel') current.blocks.set(result, (block = []));
    else block.push({ result, op, operands });
  }
  return module;
}

/** The blocks from a header's branch up to where its paths meet again. */
function construct(blocks, header) {
  const merge = blocks.get(header).find(({ op }) => op === 'OpSelectionMerge' || op === 'OpLoopMerge')?.operands[0];
  const inside = new Set();
  const open = [header];
  while (open.length > 0) {
    const end = blocks.get(open.pop()).at(-1);
    if (!BRANCHES.includes(end.op)) continue;
    for (const next of end.operands) {
      if (!blocks.has(next) || next === merge || inside.has(next)) continue;
      inside.add(next);
      open.push(next);
    }
  }
  return inside;
}

/** What a branch parts: its construct, or, where it has none of its own, all loops that it may leave or repeat. */
function parted(blocks, label) {
  const merges = (at, op) => blocks.get(at).some((instruction) => instruction.op === op);
  if (merges(label, 'OpSelectionMerge')) return construct(blocks, label);
  const all = new Set();
  for (const header of blocks.keys()) {
    if (!merges(header, 'OpLoopMerge')) continue;
    const loop = construct(blocks, header).add(header);
    if (loop.has(label)) for (const inside of loop) all.add(inside);
  }
  return all;
}

function findDivergent(module) {
  const values = new Set(); // and variables, by their own name
  const blocks = new Set();
  const roots = new Map();
  const rootOf = (pointer) => (roots.has(pointer) ? rootOf(roots.get(pointer)) : pointer);
  const functions = [...module.functions.values()];
  for (const { blocks: own } of functions) {
    for (const { result, op, operands } of [...own.values()].flat()) if (isAccess(op)) roots.set(result, operands[1]);
  }
  for (const [id, builtin] of module.builtins) if (NUMBERS.includes(builtin)) values.add(id);
  const isBuffer = (root) => BUFFERS.includes(module.globals.get(root)?.operands[1]);
  const any = (ids) => ids.some((id) => values.has(id));

  const divergesBy = ({ op, operands }) => {
    if (op === 'OpLoad') return any([operands[1], rootOf(operands[1])]);
    if (isAccess(op)) return any(operands.slice(2));
    if (op === 'OpGroupNonUniformShuffle') return any([operands[3]]);
    if (op.startsWith('OpGroupNonUniform'))
      return /Elect|ShuffleXor|ShuffleUp|ShuffleDown|InverseBallot/.test(op) || operands.some((o) => /Scan/.test(o));
    if (op === 'OpFunctionCall') return values.has(operands[1]);
    if (op === 'OpPhi') return any(operands.slice(1)) || operands.slice(1).some((id) => blocks.has(id));
    return op.startsWith('OpAtomic') || any(operands.slice(1));
  };

  let size = -1;
  while (size !== values.size + blocks.size) {
    size = values.size + blocks.size;
    for (const [id, { blocks: own }] of module.functions) {
      for (const [label, instructions] of own) {
        const apart = blocks.has(label);
        for (const instruction of instructions) {
          const { result, op, operands } = instruction;
          if (result && divergesBy(instruction)) values.add(result);
          const written = op === 'OpStore' ? rootOf(operands[0]) : null;
          if (written && !isBuffer(written) && (apart || any(operands.slice(0, 2)))) values.add(written);
          if (op === 'OpReturnValue' && (apart || any(operands))) values.add(id);
          if (op !== 'OpFunctionCall') continue;
          module.functions.get(operands[1]).parameters.forEach((parameter, i) => {
            const given = operands[2 + i];
            if (any([given, rootOf(given)])) values.add(parameter);
            if (values.has(parameter) && !isBuffer(rootOf(given)) && roots.has(given)) values.add(rootOf(given));
          });
        }
        const end = instructions.at(-1);
        if (TERMINATORS.includes(end.op) && any([end.operands[0]])) for (const b of parted(own, label)) blocks.add(b);
      }
    }
  }
  return blocks;
}

/** Sentences: which function comes to what where its invocations may be apart. */
function findings(text) {
  const module = parse(text);
  const instructions = (id) => [...module.functions.get(id).blocks.values()].flat();
  const needing = new Set();
  const needs = ({ op, operands }) => needsAll(op) || (op === 'OpFunctionCall' && needing.has(operands[1]));
  for (let size = -1; size !== needing.size; ) {
    size = needing.size;
    for (const id of module.functions.keys()) if (instructions(id).some(needs)) needing.add(id);
  }
  const apart = findDivergent(module);
  const found = new Set();
  const nameOf = (id) => module.names.get(id) ?? id;
  for (const [id, { blocks }] of module.functions) {
    for (const [label, own] of blocks) {
      if (!apart.has(label)) continue;
      for (const instruction of own.filter(needs)) {
        const what = instruction.op === 'OpFunctionCall' ? nameOf(instruction.operands[1]) : instruction.op;
        found.add(`${nameOf(id)} comes to ${what} where its invocations may have parted`);
      }
    }
  }
  return { found: [...found], needing: needing.size };
}

const [disassembler, ...files] = process.argv.slice(2);
let failed = false;
let counted = 0;
for (const file of files) {
  const text = execFileSync(disassembler, ['--no-indent', file], { encoding: 'utf8', maxBuffer: 1 << 28 });
  const { found, needing } = findings(text);
  counted += needing;
  for (const finding of found) console.log(`${basename(file)}: ${finding}`);
  failed ||= found.length > 0;
}
console.log(`${files.length} shaders, ${counted} functions with subgroup operations`);
process.exit(failed || counted === 0 ? 1 : 0);
