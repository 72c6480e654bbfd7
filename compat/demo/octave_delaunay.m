% Octave triangulates points that move, at every step: delaunay and griddata in the plane, delaunayn in space.
% Prints for each step its number, the count of cells and the sum of their areas or volumes; in the plane then the
% values that griddata interpolates from the last positions, one a line.
%
% octave_delaunay.m DIMENSION POINTS STEPS

arguments = argv();
dimension = str2double(arguments{1});
n = str2double(arguments{2});
n_steps = str2double(arguments{3});
rand("twister", 1);
randn("twister", 1);
points = rand(n, dimension);
velocity = randn(n, dimension) * 0.02 / n ^ (1 / dimension);
for step = 1:n_steps
    if dimension == 2
        cells = delaunay(points(:, 1), points(:, 2));
    else
        cells = delaunayn(points);
    endif
    edges = permute(reshape(points(cells(:, 2:end)', :), dimension, [], dimension), [2, 1, 3]);
    edges -= permute(points(cells(:, 1), :), [1, 3, 2]);
    if dimension == 2
        measures = abs(edges(:, 1, 1) .* edges(:, 2, 2) - edges(:, 1, 2) .* edges(:, 2, 1)) / 2;
    else
        a = squeeze(edges(:, 1, :));
        b = squeeze(edges(:, 2, :));
        c = squeeze(edges(:, 3, :));
        measures = abs(dot(a, cross(b, c, 2), 2)) / 6;
    endif
    % The order of cells is free, that of the sum is not.
    printf("%d %d %.17g\n", step, rows(cells), sum(sort(measures)));
    if step < n_steps
        points += velocity;
    endif
endfor
if dimension == 2
    [x, y] = meshgrid(linspace(0.1, 0.9, 60));
    printf("0 %.17g\n", griddata(points(:, 1), points(:, 2), sin(5 * points(:, 1)) .* points(:, 2), x, y));
endif
