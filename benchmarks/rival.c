/* The standard job in C: the rival that the compiled kernels are measured against.

   224 handles x 301 times on one inward spiral, places and speed ratios, by the same formulation as
   kernels/spiral.py: times abreast in blocks, one Halley step on h^2 + 4 a (a + h) sin^2(h/2) = D^2
   (repeated where it was large), polynomials for sine and cosine, angles as sums of two doubles.
   Built by benchmarks/run.py with -O3 -march=native; nothing else uses it. */
#include <math.h>
#include <stddef.h>

#ifndef LANES
#define LANES 32
#endif

static inline double small_sin(double x, double z)
{
    return x + x * z * (-1.66666666666666324348e-01 + z * (8.33333333332248946124e-03
         + z * (-1.98412698298579493134e-04 + z * (2.75573137070700676789e-06
         + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
}

static inline double small_cos(double z)
{
    return 1.0 - 0.5 * z + z * z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03
         + z * (2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07
         + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
}

static inline double nearest(double x)
{
    return (x + 6755399441055744.0) - 6755399441055744.0;
}

static inline void sine_cosine(double x, double *sine, double *cosine)
{
    double n = nearest(x * 0.63661977236758134308);
    double r = (x - n * 1.57079632673412561417) - n * 6.07710050650619224932e-11;
    double s = small_sin(r, r * r), c = small_cos(r * r);
    double q = n - 4.0 * nearest(0.25 * n - 0.375);
    int odd = q == 1.0 || q == 3.0;
    double a = odd ? c : s, b = odd ? s : c;
    *sine = q >= 2.0 ? -a : a;
    *cosine = q == 1.0 || q == 2.0 ? -b : b;
}

static double spiral_length(double k, double theta)
{
    return 0.5 * k * (theta * sqrt(1.0 + theta * theta) + asinh(theta));
}

static double spiral_angle(double k, double length)
{
    double theta = fmin(sqrt(2.0 * length / k), length / k);
    for (int i = 0; i < 40; i++) {
        double step = (spiral_length(k, theta) - length) / (k * sqrt(1.0 + theta * theta));
        theta -= step;
        if (fabs(step) <= 1e-16 * theta)
            break;
    }
    return theta;
}

/* One link in n lanes; the number of lanes whose Halley step was large. */
static int link_back(int n, double k, double d2, double scale,
                     const double *restrict u, const double *restrict ratio,
                     const double *restrict rest, const double *restrict guess,
                     double *restrict next_rest, double *restrict next_guess, double *restrict found,
                     double *restrict next_u, double *restrict x, double *restrict y,
                     double *restrict next_ratio)
{
    int large = 0;
    for (int i = 0; i < n; i++) {
        double a = u[i], h = guess[i] * scale, z = 0.25 * h * h;
        double s = small_sin(0.5 * h, z), c = small_cos(z), s2 = s * s, b = a + h;
        double f = h * h + 4.0 * a * b * s2 - d2;
        double f1 = h + 2.0 * a * s2 + 2.0 * a * b * s * c;
        double f2 = 1.0 + 4.0 * a * s * c + a * b * (1.0 - 2.0 * s2);
        double change = 2.0 * f * f1 / (4.0 * f1 * f1 - f * f2), half = 0.5 * change;
        h -= change;
        large += fabs(change * change * change) > 8e-15 * h * h;
        double s_new = s - half * c, c_new = c + half * s;
        s2 = s_new * s_new;
        double shift = h + rest[i];
        b = a + shift;
        double tail = shift - (b - a);
        double common = h + 2.0 * a * b * s_new * c_new;
        double arc_a = 1.0 + a * a, arc_b = 1.0 + b * b;
        double below = (common + 2.0 * a * s2) * arc_a, shared = 1.0 / (below * b);
        next_ratio[i] = ratio[i] * ((common - 2.0 * b * s2) * sqrt(arc_a * arc_b)) * (b * shared);
        next_rest[i] = tail;
        next_guess[i] = h * a * (below * shared);
        found[i] = h;
        double sine, cosine;
        sine_cosine(b, &sine, &cosine);
        next_u[i] = b;
        x[i] = k * b * (cosine - tail * sine);
        y[i] = k * b * (sine + tail * cosine);
    }
    return large;
}

/* u, x, y, ratio: (links + 1, times), row by row; s: arc length walked from theta0, per time. */
void march(double k, double theta0, int links, const double *link, int times, const double *s,
           double *u, double *x, double *y, double *ratio)
{
    static double buffer[5][LANES];
    double *rest = buffer[0], *guess = buffer[1], *next_rest = buffer[2], *next_guess = buffer[3];
    double *found = buffer[4];
    double start = spiral_length(k, theta0);
    for (int t = 0; t < times; t++) {
        u[t] = spiral_angle(k, start - s[t]);
        x[t] = k * u[t] * cos(u[t]);
        y[t] = k * u[t] * sin(u[t]);
        ratio[t] = 1.0;
    }
    for (int t = 0; t < times; t += LANES) {
        int n = times - t < LANES ? times - t : LANES;
        for (int l = 0; l < n; l++) {
            rest[l] = 0.0;
            guess[l] = link[0] / (k * u[t + l]);
        }
        for (int i = 0; i < links; i++) {
            double d = link[i] / k, scale = i ? link[i] / link[i - 1] : 1.0;
            ptrdiff_t here = (ptrdiff_t)i * times + t, there = here + times;
            while (link_back(n, k, d * d, scale, u + here, ratio + here, rest, guess, next_rest,
                             next_guess, found, u + there, x + there, y + there, ratio + there)) {
                double *swap = guess;
                guess = found;
                found = swap;
                scale = 1.0;
            }
            double *swap = rest;
            rest = next_rest;
            next_rest = swap;
            swap = guess;
            guess = next_guess;
            next_guess = swap;
        }
    }
}
