#include "circumcentre.hpp"

namespace compat {

namespace {

// A sum without rounding: doubles that do not overlap, the smallest first. Exact where products neither overflow nor
// underflow.
template <int capacity>
class ExactSum {
public:
    void add(double value) {
        int kept = 0;
        for (int i = 0; i < count_; i++) {
            const double sum = value + terms_[i];
            const double part = sum - value;
            const double rest = (value - (sum - part)) + (terms_[i] - part);
            if (rest != 0) terms_[kept++] = rest;
            value = sum;
        }
        if (value != 0) terms_[kept++] = value;
        count_ = kept;
    }

    void add_product(double a, double b) {
        const double product = a * b;
        add(std::fma(a, b, -product));
        add(product);
    }

    void add_product(double a, double b, double c) {
        const double product = a * b;
        add_product(std::fma(a, b, -product), c);
        add_product(product, c);
    }

    double value() const {
        double sum = 0;
        for (int i = 0; i < count_; i++) sum += terms_[i];
        return sum;
    }

private:
    double terms_[capacity];
    int count_ = 0;
};

// The determinant of b - a, c - a, d - a: the sum over the points of the determinants of the other three.
double exact_determinant_3d(const double *a, const double *b, const double *c, const double *d) {
    ExactSum<96> sum;
    const double *others[4][3] = {{b, c, d}, {a, d, c}, {a, b, d}, {a, c, b}};
    for (const auto &[p, q, r] : others) {
        for (int axis = 0; axis < 3; axis++) {
            const int next = (axis + 1) % 3, last = (axis + 2) % 3;
            sum.add_product(p[axis], q[next], r[last]);
            sum.add_product(-p[axis], q[last], r[next]);
        }
    }
    return sum.value();
}

} // namespace

double exact_determinant_2d(const double *a, const double *b, const double *c) {
    ExactSum<12> sum;
    const double *points[] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        const double *p = points[i], *q = points[(i + 1) % 3];
        sum.add_product(p[0], q[1]);
        sum.add_product(-p[1], q[0]);
    }
    return sum.value();
}

void circumcentre_3d(const double *a, const double *b, const double *c, const double *d, const double *weights,
                     double *centre) {
    double edge[3][3], squared[3];
    const double *ends[] = {b, c, d};
    for (int i = 0; i < 3; i++) {
        squared[i] = 0;
        for (int axis = 0; axis < 3; axis++) {
            edge[i][axis] = ends[i][axis] - a[axis];
            squared[i] += edge[i][axis] * edge[i][axis];
        }
        if (weights != nullptr) squared[i] += weights[0] - weights[i + 1];
    }
    double determinant = 0, terms = 0, sum[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; axis++) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        for (int i = 0; i < 3; i++) {
            const double *u = edge[(i + 1) % 3], *v = edge[(i + 2) % 3];
            const double plus = u[next] * v[last], minus = u[last] * v[next];
            sum[axis] += squared[i] * (plus - minus);
            if (i > 0) continue;
            determinant += edge[0][axis] * (plus - minus);
            terms += std::abs(edge[0][axis]) * (std::abs(plus) + std::abs(minus));
        }
    }
    if (std::abs(determinant) < lossy * terms) determinant = exact_determinant_3d(a, b, c, d);
    const double half = 0.5 / determinant;
    for (int axis = 0; axis < 3; axis++) centre[axis] = a[axis] + sum[axis] * half;
}

} // namespace compat
