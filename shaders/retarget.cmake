# The compiler names its temporary output in the dependency file; ninja wants the final name there.
file(READ ${DEPFILE} text)
string(REPLACE "${FROM}:" "${TO}:" text "${text}")
file(WRITE ${DEPFILE} "${text}")
