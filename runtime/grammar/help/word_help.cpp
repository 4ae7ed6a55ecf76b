#include "grammar/help/word_help.h"

#include <algorithm>
#include <array>

#include "base/plain_text.h"
#include "grammar/syntax/ast.h"
#include "grammar/syntax/builtins.h"

namespace sgm {
namespace {

struct Help {
  std::string_view word, text;
};

constexpr std::array<Help, 154> kHelp = {{
    {"above", "of halfspace: solid above this height; of components: only pieces above this volume"},
    {"abs", "without its sign"},
    {"air", "of components: of the void"},
    {"amp", "the largest amount of a displacement or a warp"},
    {"anchor", "an oriented point for the game: `anchor KIND \"name\";`"},
    {"and", "both conditions hold"},
    {"animated", "a parameter that is meant to be driven while the world is watched"},
    {"as", "the name that an import or a plan has from here on"},
    {"at", "moves what follows: `at(x, y, z)`, `at(y 2m)` or `at(point)`"},
    {"atan2", "the angle of a direction, from x towards y"},
    {"axes", "the axes along which an infinite domain has cells: `axes xz`"},
    {"beam", "like a tube, with a square section"},
    {"blob", "a ball as a part of `sum`"},
    {"block", "of an expectation: a block with so many cells along an edge"},
    {"border", "of wfc: what stands outside of the scope: `border side sky, bottom ground;`"},
    {"box", "a box with these full edges; `box(scope)` fills the scope"},
    {"branch", "the segments of a branching skeleton from the origin along +y"},
    {"by", "the parameter of a morphic rule, or the door of a link"},
    {"ca", "caves of a cellular automaton over voxels"},
    {"capsule", "from a to b, with round ends"},
    {"ceil", "the whole number above"},
    {"cell", "the cell that is derived; of a layer: the edge of its cells"},
    {"cellnoise", "smooth noise of 0 to 1 over cells"},
    {"chance", "true with this probability, by the derivation path, or by a key alone"},
    {"clamp", "the value, held between low and high"},
    {"clear", "of query: all is void there"},
    {"cm", "a hundredth of a metre"},
    {"comp", "takes a scope's box apart: `comp { front: A; side: B; top: C; edges: D; inside: E; }`"},
    {"corridor", "of treemap: how wide, and what stands in it"},
    {"cos", "the cosine of an angle"},
    {"cut", "takes a block away from what precedes it in its own block; `smooth` rounds the edge"},
    {"cylinder", "along y: radius and full height"},
    {"density", "`output density edge 20m`: a volume for fog, beside the mesh"},
    {"depth", "bounded recursion: `depth n -> Other` is derived instead where the rule is n deep in itself"},
    {"detail", "`detail 30cm { ... }`: left out at levels whose cells are larger"},
    {"disc", "points in a circle of this radius"},
    {"displace", "moves a surface along its normal by a field: `displace rock.fbm(period 5m, amp 0.7m) { ... }`"},
    {"domain",
     "where the world is and what it is made of: `domain infinite solid limestone;`, `domain box(40m, 20m, 40m);`"},
    {"door", "of treemap and link: width and height of doors"},
    {"down", "of probe: towards -y"},
    {"edge", "of output density: over which density rises from the surface"},
    {"ellipsoid", "with these radii along x, y and z"},
    {"else", "a head of a rule that holds where no other does, or the other value of `if`"},
    {"empty", "a domain of air"},
    {"expect", "a test of the world in the grammar's own text, which `sgm check --expect` evaluates"},
    {"extrude", "a solid over a plan: `extrude 12m of plan { ... }`"},
    {"facade", "of treemap: what stands at each outer wall"},
    {"false", "a condition that never holds"},
    {"field", "a value that varies from point to point: `field t = smoothstep(0m, 20m, p.y);`"},
    {"finite", "a domain of one piece"},
    {"fit", "an asset in the scope's size, its angles kept: `fit bay stretch x 1m..2m repeat y 1m..4m;`"},
    {"flat", "a roof of this height, or a base"},
    {"floor", "the whole number below"},
    {"footprint", "a plan of merged pieces: `footprint merge 3 rect(12m, 9m) as plan;`"},
    {"for", "once for each: `for i in 0..4 { ... }`, `for f in cell.links() { ... }`, `for s in branch(...) { ... }`"},
    {"fract", "what remains above the whole number below, 0 to 1"},
    {"fractal", "gradient noise of -1 to 1 of the point; each octave has half the period of the one before"},
    {"from", "where a segment begins; of snap: where the first plane lies"},
    {"gable", "a roof with two slopes of this pitch"},
    {"gap", "of probe: the name of the free length the other way"},
    {"halfspace", "all below, or all above, a height; meet it with something, or cut with it"},
    {"hip", "a roof with slopes on all sides, of this pitch"},
    {"if", "one of two values: `if a > 2m then a else 2m`"},
    {"import",
     "another file's rules and functions, `import \"std/rock.sgm\" as rock;`, or an asset, `import \"bay.glb\" as "
     "bay;`"},
    {"in", "the range of a parameter or of a loop"},
    {"infinite", "a domain without end, in cells"},
    {"inner", "in an override's block: what it takes the place of"},
    {"inside", "of comp: the box itself; of query: all is solid there"},
    {"km", "a thousand metres"},
    {"layer", "a grid of cells that derive by themselves: `layer net cell 96m reach 90m { start Node; }`"},
    {"length", "the length of a vector"},
    {"lerp", "of morph: by the mean of both fields"},
    {"let", "a name for a value: `let r = rand(1m, 2m);`, `let hub(c) = c.point(jitter 0.3);`"},
    {"link", "a door between two rooms of a treemap: `link living bath by door;`"},
    {"links", "of a cell: the faces that passages cross, so that all cells are connected"},
    {"lod",
     "a head of a rule that stands in at levels whose cells are at least that large: `rule House lod 4m { ... }`"},
    {"m", "a metre"},
    {"mat", "the material of all that is in this block"},
    {"max", "the larger of two"},
    {"meet", "what the statements of its block have in common; `smooth` rounds the edge"},
    {"meets", "of wfc: which labels of the other side this one meets"},
    {"merge", "of footprint: the number of pieces"},
    {"min", "the smaller of two"},
    {"minsize", "bounded recursion: `minsize 1m -> Other` is derived instead where the size is smaller"},
    {"mirror", "mirrors what follows along an axis: `mirror(x)`"},
    {"mix", "from a at t = 0 to b at t = 1"},
    {"mm", "a thousandth of a metre"},
    {"morph", "a shape between two: `morph(sphere(2m), box(3m), t)`; `power` by the exponent"},
    {"morphic", "a rule that is one node: `morphic Body(r): sphere(r) -> box(2*r) by t;`"},
    {"not", "the condition does not hold"},
    {"of", "names what is meant: a plan, a layer"},
    {"on", "where points are scattered"},
    {"or", "one of the conditions holds, or both"},
    {"output", "what the world gives beside its mesh"},
    {"override",
     "a block in the place of what rules derive: `override \"Lot/Tower/Floor[2]\" { ... }`, `override tag \"door\" { "
     "... }`"},
    {"p", "in fields: the point in the world"},
    {"param", "a value that the host sets: `param wet = 50% in 0%..100% \"how wet\";`"},
    {"per", "of an expectation: for each use of a rule"},
    {"point", "of a cell or a face: a point in it, the same for all that use it"},
    {"poisson", "points no nearer to each other than this"},
    {"polygon", "a plan with these corners"},
    {"pow", "a to the power of b"},
    {"power", "of morph: by the exponent of a superquadric"},
    {"prism", "a polygon in x and z over a full height"},
    {"probe", "of scatter: each point goes to the surface of a layer below: `probe up 4m of net`"},
    {"q", "in fields: the point in the scope"},
    {"query", "a condition about the layers below: `query clear 3m of net`, `query inside of net`"},
    {"rand", "drawn from a to b by the derivation path, or by a key alone"},
    {"reach", "how far shapes of a layer may leave their cell"},
    {"rect", "a plan: a rectangle"},
    {"regular", "a plan: a regular polygon"},
    {"repeat",
     "n copies, each moved on by the transforms: `repeat 4 at(2m, 0m, 0m) sphere(1m);`; of fit: a zone that is copied"},
    {"report", "a measure that `sgm check --expect` prints"},
    {"roof", "over a scope or a plan: `roof flat(1m)`, `roof gable(40deg)`, `roof hip(30deg, overhang 0.5m) of plan`"},
    {"rot", "turns what follows: `rot(y, 45deg)`, right-handed"},
    {"rule", "how a name is derived; several heads are alternatives: `rule Hall(r in 1m..60m) weight 3 { ... }`"},
    {"scale", "makes what follows larger or smaller: `scale(0.5)`"},
    {"scatter", "points without order: `scatter poisson(2m) { ... }`, `scatter 6 on shell(r) { ... }`"},
    {"scope", "the edges of the scope's box: scope.x, scope.y, scope.z"},
    {"seed", "of the grammar, beside the world's: `seed \"block-17\";`"},
    {"sgm", "the version of the language: `sgm 1;`"},
    {"shell", "points on a sphere of this radius; `up 60%`: its upper part"},
    {"sin", "the sine of an angle"},
    {"size", "the edges of the scope's box: `size(4m, 3m, 4m)`, `size(z 0.3m)`"},
    {"smooth", "rounds where shapes meet, by this radius"},
    {"smoothstep", "0 at low, 1 at high, smooth between them"},
    {"snap", "planes that lines of splits go to: `snap y 3.2m { ... }`"},
    {"solid", "a domain of rock; of components: of the solid"},
    {"sphere", "a ball"},
    {"split", "shares a scope among parts along an axis: `split x { 2m: A; { ~1.6m: B; }* 25%: C; }`"},
    {"sqrt", "the square root"},
    {"start", "the rule that derivation begins with"},
    {"stretch", "of fit: a zone that takes up the difference in size: `fit bay stretch x 1m..2m;`"},
    {"sum", "a sum of blobs that flow together"},
    {"superq", "from ellipsoid (square 0) to nearly a box (square 1)"},
    {"tag", "a word for all that is in this block, for games, pictures and overrides"},
    {"then", "the first value of `if`"},
    {"torus", "a ring about y: radii of the ring and of the tube"},
    {"treemap", "the floor of a scope in rooms: `treemap(wall 0.2m) { living 28: A; bath 6: B; }`"},
    {"true", "a condition that always holds"},
    {"truncone", "a cone without its tip, along y: full height, radii at the top and at the bottom"},
    {"tube", "a round passage from a to b that bends by at most `bend`"},
    {"turn", "of wfc: the tile stands turned about y as well; of branch: the angle of a turn"},
    {"u", "in fields: 0 to 1 along the tube or beam around"},
    {"union", "all of a block's statements together; `smooth 2m` rounds where they meet"},
    {"units", "the unit of bare lengths from outside and of messages: `units m;`"},
    {"up", "of probe: towards +y; of shell: the share from the top"},
    {"uses", "the layers below that this one asks"},
    {"vec", "a vector, the same as (x, y, z)"},
    {"warp", "bends space by a vector field: `warp (f, 0m, g) amp 1m { ... }`"},
    {"weight", "how often this head is drawn among those that hold"},
    {"wfc",
     "tiles in a lattice, so that sides which touch meet: `wfc 6m { wall 3 turn, front meadow, back yard: Wall; }`"},
    {"when", "a guard: the head holds where the condition does"},
    {"within", "of gap: points with a longer one are left out"},
}};
static_assert(std::is_sorted(kHelp.begin(), kHelp.end(), [](const Help& a, const Help& b) { return a.word < b.word; }));

constexpr bool hasHelp(std::string_view word) {
  return word.empty() || std::ranges::binary_search(kHelp, word, {}, &Help::word);
}
static_assert(std::ranges::all_of(kStmtInfos, hasHelp, &StmtInfo::word), "a word of stmts.def has no help");

std::string form(std::string_view name, std::span<const BuiltinParam> params, bool variadic) {
  std::string text(name);
  text += '(';
  for (size_t i = 0; i < params.size(); ++i) {
    const BuiltinParam& param = params[i];
    if (i > 0) text += ", ";
    text += param.name;
    if (param.required) continue;
    text += " = " + generalText(param.fallback);
  }
  return text += variadic ? ", ...)" : ")";
}

}  // namespace

std::string_view wordHelp(std::string_view word) {
  const auto found = std::ranges::lower_bound(kHelp, word, {}, &Help::word);
  return found != kHelp.end() && found->word == word ? found->text : std::string_view();
}

std::string callForms(std::string_view word) {
  std::string forms;
  for (const PrimitiveInfo& primitive : primitiveTable())
    if (primitive.name == word) forms = form(word, primitive.params, primitive.variadic);
  for (const BuiltinInfo& builtin : builtinTable()) {
    if (builtin.name != word) continue;
    const std::string one = form(word, builtin.params, false);
    if (forms.find(one) == std::string::npos) forms.append(forms.empty() ? "" : "\n").append(one);
  }
  return forms;
}

}  // namespace sgm
