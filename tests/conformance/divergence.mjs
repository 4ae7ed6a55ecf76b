// Finds collective operations (of subgroups and workgroups) in SPIR-V that not all invocations may reach, in shaders
// that rely on all of them (shaders/mesher/tape.glsl). Software Vulkan hides such bugs: masked lanes still contribute
// their values there. On real hardware they do not.
//
//   node divergence.mjs SPIRV-DIS FILE.spv...      status 3 if it finds one, 1 if it cannot analyse a file
//
// A value is divergent if invocations may have different values of it: an invocation's index, a value computed from a
// divergent one, and a variable written after a divergent branch. Reading a buffer at a uniform address gives a uniform
// value, unless invocations write there meanwhile. The analysis ignores call sites and the order of writes, so it may
// report too much. It assumes that invocations reconverge where SPIR-V's structured constructs end.
import { execFileSync } from 'node:child_process';
import { basename } from 'node:path';

const NUMBERS = ['LocalInvocationId', 'LocalInvocationIndex', 'GlobalInvocationId', 'SubgroupLocalInvocationId',
  'SubgroupEqMask', 'SubgroupGeMask', 'SubgroupGtMask', 'SubgroupLeMask', 'SubgroupLtMask'];
const BUFFERS = ['StorageBuffer', 'Uniform', 'PushConstant'];
const CHOICES = ['OpBranchConditional', 'OpSwitch'];
const BRANCHES = ['OpBranch', ...CHOICES];
const LEAVING = ['OpReturn', 'OpReturnValue', 'OpKill', 'OpTerminateInvocation'];
// Operations that return the same value to all invocations of a subgroup. Operations with the operand Reduce also do.
const SHARED = /^OpGroupNonUniform(All|Any|AllEqual|BroadcastFirst|Ballot|BallotFindLSB|BallotFindMSB)$/;
const isAccess = (op) => op === 'OpAccessChain' || op === 'OpInBoundsAccessChain';
const isSubgroup = (op) => op.startsWith('OpGroupNonUniform');
const isBarrier = (op) => op === 'OpControlBarrier';

/**
 * Parses the disassembly of a module into its functions, each with its blocks of instructions, and everything outside
 * of functions.
 */
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

const endOf = (blocks, label) => blocks.get(label).at(-1);
const nextOf = (blocks, label) => {
  const { op, operands } = endOf(blocks, label);
  return BRANCHES.includes(op) ? operands.filter((id) => blocks.has(id)) : [];
};

/** Returns the blocks reachable from `label` without passing a block of `stops`. */
function following(blocks, label, stops) {
  const found = new Set();
  const open = [label];
  while (open.length > 0) {
    for (const next of nextOf(blocks, open.pop())) {
      if (stops.includes(next) || found.has(next)) continue;
      found.add(next);
      open.push(next);
    }
  }
  return found;
}

/** Returns the loops of a function: for each header, the loop's blocks, its merge block, and its continue target. */
function loopsOf(blocks) {
  const loops = [];
  for (const [header, instructions] of blocks) {
    const [merge, next] = instructions.find(({ op }) => op === 'OpLoopMerge')?.operands ?? [];
    if (merge) loops.push({ inside: following(blocks, header, [merge]).add(header), merge, next });
  }
  return loops;
}

/**
 * Returns the blocks that invocations may execute separately after a divergent branch: all blocks on its paths, up to
 * the block where the paths merge. If a path leaves or continues a loop, these are all blocks of the loop; if a path
 * returns from the function, all blocks that may follow.
 */
function parted(blocks, loops, label) {
  const around = loops.filter(({ inside }) => inside.has(label));
  const ends = around.flatMap(({ merge, next }) => [merge, next]);
  const merge = blocks.get(label).find(({ op }) => op === 'OpSelectionMerge')?.operands[0];
  const own = merge ? following(blocks, label, [merge, ...ends]) : new Set();
  const all = new Set(own);
  const reached = [label, ...own].flatMap((block) => nextOf(blocks, block));
  for (const loop of around) {
    if (reached.includes(loop.merge) || reached.includes(loop.next)) for (const block of loop.inside) all.add(block);
  }
  if ([...own].some((block) => LEAVING.includes(endOf(blocks, block).op)))
    for (const block of following(blocks, label, [])) all.add(block);
  return all;
}

/** Returns the blocks that the invocations of a subgroup (or of a workgroup) may not all reach together. */
function findDivergent(module, ofWorkgroup) {
  const values = new Set(); // ids of divergent values, and of variables that contain such values
  const blocks = new Set();
  const calledApart = new Set();
  const roots = new Map();
  const variables = new Set(module.globals.keys());
  const rootOf = (pointer) => (roots.has(pointer) ? rootOf(roots.get(pointer)) : pointer);
  const loops = new Map();
  for (const [id, { blocks: own }] of module.functions) {
    loops.set(id, loopsOf(own));
    for (const { result, op, operands } of [...own.values()].flat()) {
      if (isAccess(op)) roots.set(result, operands[1]);
      if (op === 'OpVariable') variables.add(result);
    }
  }
  const differing = ofWorkgroup ? [...NUMBERS, 'SubgroupId'] : NUMBERS;
  for (const [id, builtin] of module.builtins) if (differing.includes(builtin)) values.add(id);
  const isBuffer = (root) => BUFFERS.includes(module.globals.get(root)?.operands[1]);
  const any = (ids) => ids.some((id) => values.has(id));

  const divergesBy = ({ op, operands }) => {
    if (op === 'OpLoad') return any([operands[1], rootOf(operands[1])]);
    if (isAccess(op)) return any(operands.slice(2));
    if (isSubgroup(op)) {
      if (ofWorkgroup) return true;
      if (/^OpGroupNonUniform(Shuffle|Broadcast)$/.test(op)) return any([operands[3]]);
      return !SHARED.test(op) && !operands.includes('Reduce');
    }
    if (op === 'OpFunctionCall') return values.has(operands[1]);
    if (op === 'OpPhi') return any(operands.slice(1)) || operands.slice(1).some((id) => blocks.has(id));
    return op.startsWith('OpAtomic') || any(operands.slice(1));
  };

  const count = () => values.size + blocks.size + calledApart.size;
  for (let size = -1; size !== count(); ) {
    size = count();
    for (const [id, { blocks: own }] of module.functions) {
      for (const [label, instructions] of own) {
        const apart = blocks.has(label) || calledApart.has(id);
        for (const instruction of instructions) {
          const { result, op, operands } = instruction;
          if (result && divergesBy(instruction)) values.add(result);
          const written = op === 'OpStore' ? rootOf(operands[0]) : null;
          if (written && !isBuffer(written) && (apart || any(operands.slice(0, 2)))) values.add(written);
          if (op === 'OpReturnValue' && (apart || any(operands))) values.add(id);
          if (op !== 'OpFunctionCall') continue;
          if (apart) calledApart.add(operands[1]);
          module.functions.get(operands[1]).parameters.forEach((parameter, i) => {
            const given = rootOf(operands[2 + i]);
            if (any([operands[2 + i], given])) values.add(parameter);
            if (values.has(parameter) && variables.has(given) && !isBuffer(given)) values.add(given);
          });
        }
        const end = instructions.at(-1);
        if (!CHOICES.includes(end.op) || !values.has(end.operands[0])) continue;
        for (const block of parted(own, loops.get(id), label)) blocks.add(block);
      }
    }
  }
  return blocks;
}

/**
 * Returns one sentence for each function that executes a collective operation where its invocations may have diverged.
 */
function findings(text) {
  const module = parse(text);
  const found = new Set();
  const nameOf = (id) => module.names.get(id) ?? id;
  let count = 0;
  for (const [isMeant, apart] of [
    [isSubgroup, findDivergent(module, false)],
    [isBarrier, findDivergent(module, true)],
  ]) {
    const meaning = new Set();
    const means = ({ op, operands }) => isMeant(op) || (op === 'OpFunctionCall' && meaning.has(operands[1]));
    for (let size = -1; size !== meaning.size; ) {
      size = meaning.size;
      for (const [id, { blocks }] of module.functions) if ([...blocks.values()].flat().some(means)) meaning.add(id);
    }
    count += meaning.size;
    for (const [id, { blocks }] of module.functions) {
      for (const [label, own] of blocks) {
        if (!apart.has(label)) continue;
        for (const instruction of own.filter(means)) {
          const what = instruction.op === 'OpFunctionCall' ? nameOf(instruction.operands[1]) : instruction.op;
          found.add(`${nameOf(id)} comes to ${what} where its invocations may have parted`);
        }
      }
    }
  }
  return { found: [...found], count };
}

const [disassembler, ...files] = process.argv.slice(2);
let failed = false;
let counted = 0;
for (const file of files) {
  const text = execFileSync(disassembler, ['--no-indent', file], { encoding: 'utf8', maxBuffer: 1 << 28 });
  const { found, count } = findings(text);
  counted += count;
  for (const finding of found) console.log(`${basename(file)}: ${finding}`);
  failed ||= found.length > 0;
}
console.log(`${files.length} shaders, ${counted} functions with subgroup operations or barriers`);
process.exit(failed ? 3 : counted === 0 ? 1 : 0);
