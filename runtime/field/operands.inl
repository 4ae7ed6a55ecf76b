// Returns the mask of registers that an instruction reads, one bit each. prune_kernel.inl and evaluate_blocks.inl
// include this file, so that the function lands in the namespace of the file that includes those two.

SGM_KERNEL uint32_t operandMask(const Instr& in) {
  const uint32_t a = 1u << in.a, b = 1u << in.b, c = 1u << in.c;
  switch (in.op) {
#define SGM_FORM_CONSTANT 0
#define SGM_FORM_POSITION 0
#define SGM_FORM_POSITION_1 a
#define SGM_FORM_UNARY a
#define SGM_FORM_UNARY_P a
#define SGM_FORM_BINARY a | b
#define SGM_FORM_TERNARY a | b | c
#define SGM_FORM_COPY a
#define SGM_FORM_ROUND_BEGIN 0
#define SGM_FORM_ROUND_ADD a | b | 1u << in.dst
#define SGM_FORM_ROUND_END a | b
#define SGM_FORM_SUM_BEGIN 0
#define SGM_FORM_SUM_ADD a | b | 1u << in.dst
#define SGM_FORM_SUM_END a | b
#define SGM_FORM_WARP a | b | c
#define SGM_OP(name, function, form, error) \
  case Op::name:                            \
    return SGM_FORM_##form;
#include "field/ops.def"
#undef SGM_OP
    case Op::count:
      break;
  }
  return 0;
}

#undef SGM_FORM_CONSTANT
#undef SGM_FORM_POSITION
#undef SGM_FORM_POSITION_1
#undef SGM_FORM_UNARY
#undef SGM_FORM_UNARY_P
#undef SGM_FORM_BINARY
#undef SGM_FORM_TERNARY
#undef SGM_FORM_COPY
#undef SGM_FORM_ROUND_BEGIN
#undef SGM_FORM_ROUND_ADD
#undef SGM_FORM_ROUND_END
#undef SGM_FORM_SUM_BEGIN
#undef SGM_FORM_SUM_ADD
#undef SGM_FORM_SUM_END
#undef SGM_FORM_WARP
