# Replaces the target's name in the dependency file: the compiler writes the name of its temporary output, but ninja
# needs the final name.
file(READ ${DEPFILE} text)
string(REPLACE "${FROM}:" "${TO}:" text "${text}")
file(WRITE ${DEPFILE} "${text}")
