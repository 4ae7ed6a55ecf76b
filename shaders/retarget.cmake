# The compiler writes its temporary output's name into the dependency file; ninja needs the final name.
file(READ ${DEPFILE} text)
string(REPLACE "${FROM}:" "${TO}:" text "${text}")
file(WRITE ${DEPFILE} "${text}")
