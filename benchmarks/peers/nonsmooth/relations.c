/* Contacts for Siconos: gaps h and their gradients G, column by column, of a normal and a tangential direction. */
#include <math.h>

typedef unsigned U;

/* A bead inside a hoop of radius 0.5, q = (x, y). */
void hoop_h(U n, const double *q, U m, double *y, U s, double *z) {
    y[0] = 0.5 - hypot(q[0], q[1]);
    y[1] = 0;
}
void hoop_G(U n, const double *q, U m, double *G, U s, double *z) {
    double r = hypot(q[0], q[1]);
    G[0] = -q[0] / r;
    G[1] = -q[1] / r;
    G[2] = -q[1] / r;
    G[3] = q[0] / r;
}

/* The corners of a block of half width 0.2 and half height 0.5, q = (x, y, angle). */
static void corner(double side, const double *q, double *y, double *G) {
    double c = cos(q[2]), s = sin(q[2]), px = side * 0.2 * c + 0.5 * s, py = side * 0.2 * s - 0.5 * c;
    if (y) {
        y[0] = q[1] + py;
        y[1] = q[0] + px;
    }
    if (G) {
        G[0] = 0;
        G[1] = 1;
        G[2] = 1;
        G[3] = 0;
        G[4] = px;
        G[5] = -py;
    }
}
void left_h(U n, const double *q, U m, double *y, U s, double *z) { corner(-1, q, y, 0); }
void left_G(U n, const double *q, U m, double *G, U s, double *z) { corner(-1, q, 0, G); }
void right_h(U n, const double *q, U m, double *y, U s, double *z) { corner(1, q, y, 0); }
void right_G(U n, const double *q, U m, double *G, U s, double *z) { corner(1, q, 0, G); }
