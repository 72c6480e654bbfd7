! Calls from Fortran: a lattice that is made, moved and read, in the plane and in space, and what is refused.
program test
   use deldrift
   implicit none
   integer :: failures = 0
   call plane()
   call space()
   call refusals()
   if (failures > 0) error stop 1
   print '(a)', 'passed'

contains

   subroutine check(holds, text)
      logical, intent(in) :: holds
      character(*), intent(in) :: text
      if (holds) return
      failures = failures + 1
      print '(3a)', text, ' does not hold; last message: ', deldrift_message()
   end subroutine

   ! A square of 5 x 5 vertices, of which each row is shifted: areas add up to that of the hull.
   subroutine plane()
      real(c_double) :: positions(2, 25), areas(64), low(2) = -1, high(2) = 6
      type(deldrift_commit_report) :: report
      type(deldrift_options) :: options
      type(deldrift_cells_view) :: view
      type(c_ptr) :: t
      integer(c_int32_t), pointer :: corners(:, :)
      integer(c_size_t) :: n
      integer :: i
      do i = 1, 25
         positions(:, i) = [real(mod(i - 1, 5), c_double), real((i - 1) / 5, c_double)]
      end do
      options%algorithm = DELDRIFT_TOLERANCE_VALUE
      options%threads = 1
      call check(deldrift_create(2, positions, 25_c_size_t, options, t) == DELDRIFT_OK, 'create')
      call check(deldrift_cell_count(t, n) == DELDRIFT_OK .and. n == 32, 'a square has 32 triangles')
      positions(1, :) = positions(1, :) + 0.25 * positions(2, :)
      call check(deldrift_commit_positions(t, positions, 25_c_size_t, report) == DELDRIFT_OK, 'commit')
      call check(report%timestamp == 1 .and. report%moved == 20, 'all rows but the first have moved')
      call check(deldrift_volumes(t, areas, 64_c_size_t, n) == DELDRIFT_OK, 'areas')
      call check(abs(sum(areas(:n)) - 16) < 1e-12_c_double, 'areas add up to 16')
      call check(deldrift_cells(t, view) == DELDRIFT_OK .and. view%count == n, 'cells')
      call c_f_pointer(view%vertices, corners, [3_c_size_t, n])
      call check(minval(corners) == 0 .and. maxval(corners) == 24, 'ids count from 0')
      ! Without a report, and with coordinates for one vertex.
      call check(deldrift_move_vertices(t, [3_c_int32_t], [9.0_c_double, 9.0_c_double], 1_c_size_t) == DELDRIFT_OK, 'move')
      call check(deldrift_commit_timestamp(t) == DELDRIFT_OK, 'a report can be left out')
      call check(deldrift_voronoi_volumes(t, low, high, areas, 64_c_size_t, n) == DELDRIFT_OK .and. n == 25, 'Voronoi')
      call check(abs(sum(areas(:25)) - 49) < 1e-9_c_double, 'Voronoi cells fill the box but for a vertex outside')
      call deldrift_destroy(t)
   end subroutine

   ! A cube with weights: the vertex in its middle is hidden until it is heavy.
   subroutine space()
      real(c_double) :: positions(3, 9), weights(9)
      type(c_ptr) :: t
      integer(c_int32_t) :: hidden(9)
      integer(c_size_t) :: n
      integer :: i
      do i = 1, 8
         positions(:, i) = [real(mod(i - 1, 2), c_double), real(mod((i - 1) / 2, 2), c_double), &
                            real((i - 1) / 4, c_double)]
      end do
      positions(:, 9) = 0.5
      weights = 1
      weights(9) = 0
      call check(deldrift_create_weighted(3, positions, weights, count=9_c_size_t, out=t) == DELDRIFT_OK, 'weights')
      call check(deldrift_hidden_by_weight(t, hidden, capacity=9_c_size_t, count=n) == DELDRIFT_OK .and. n == 1, 'hidden')
      call check(hidden(1) == 8, 'the middle is hidden')
      call check(deldrift_set_weight(t, 8, 1.0_c_double) == DELDRIFT_OK, 'a weight')
      call check(deldrift_cell_count(t, n) == DELDRIFT_OK .and. n == 12, 'two tetrahedra for each side')
      call deldrift_destroy(t)
   end subroutine

   subroutine refusals()
      type(c_ptr) :: t
      integer(c_size_t) :: n
      call check(deldrift_create(5, out=t, count=0_c_size_t) == DELDRIFT_INVALID_DIMENSION, 'five dimensions')
      call check(index(deldrift_message(), '5') > 0, 'the message says which')
      call check(deldrift_cell_count(c_null_ptr, n) == DELDRIFT_NULL_ARGUMENT, 'no triangulation')
      call check(deldrift_message() == 't is NULL', 'the message names it')
   end subroutine
end program
