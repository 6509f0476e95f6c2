/* The number of tetrahedra in a cube, 0 if there is none. */
unsigned wrap_cube(void);
