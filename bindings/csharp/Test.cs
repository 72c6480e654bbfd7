// Calls from C#: a square that is made, moved and read, and what is refused.
using System;

public static class Test
{
    static int failures;

    static void Check(bool holds, string text)
    {
        if (holds) return;
        failures++;
        Console.WriteLine($"{text} does not hold; last message: {Deldrift.Message()}");
    }

    public static int Main()
    {
        var positions = new double[50];
        for (int i = 0; i < 25; i++)
        {
            positions[2 * i] = i % 5;
            positions[2 * i + 1] = i / 5;
        }
        IntPtr t;
        var options = Deldrift.deldrift_options.Defaults();
        options.threads = 1;
        Check(Deldrift.deldrift_create(2, positions, (UIntPtr)25, ref options, out t) == Deldrift.DELDRIFT_OK, "create");
        for (int i = 0; i < 25; i++) positions[2 * i] += 0.25 * positions[2 * i + 1];
        var report = new Deldrift.deldrift_commit_report();
        Check(Deldrift.deldrift_commit_positions(t, positions, (UIntPtr)25, ref report) == Deldrift.DELDRIFT_OK, "commit");
        Check(report.timestamp == 1 && report.moved == 20, "all rows but the first have moved");
        UIntPtr n = UIntPtr.Zero;
        var areas = new double[64];
        Check(Deldrift.deldrift_volumes(t, areas, (UIntPtr)64, ref n) == Deldrift.DELDRIFT_OK && n == (UIntPtr)32, "areas");
        double sum = 0;
        for (int k = 0; k < 32; k++) sum += areas[k];
        Check(Math.Abs(sum - 16) < 1e-12, "areas add up to 16");
        Deldrift.deldrift_destroy(t);
        Check(Deldrift.deldrift_create(5, null, UIntPtr.Zero, ref options, out t) == Deldrift.DELDRIFT_INVALID_DIMENSION, "five dimensions");
        Check(Deldrift.Message().Contains("5"), "the message says which");
        Check(Deldrift.deldrift_cell_count(IntPtr.Zero, ref n) == Deldrift.DELDRIFT_NULL_ARGUMENT, "no triangulation");
        if (failures == 0) Console.WriteLine("passed");
        return failures;
    }
}
